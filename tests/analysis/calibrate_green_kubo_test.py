# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The calibration study: its made-up stresses have the correlation that is claimed for them, and it tells honest error
bars from others (those of a stand-in for the program, with estimates of known scatter). Exit code 77 (skipped) without
numpy and matplotlib."""

import contextlib
import csv
import io
import json
import math
import os
import pathlib
import sys
import tempfile
import types
import unittest
import unittest.mock

try:
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError:
    print("skipped: /usr/bin/python3 lacks numpy or matplotlib")
    sys.exit(77)

SCRIPTS = pathlib.Path(os.environ.get("LUCY_SOURCE_DIRECTORY", pathlib.Path(__file__).parents[2])) / "analysis"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True
import calibrate_green_kubo as calibration  # noqa: E402
import lucy_tables  # noqa: E402

lucy_tables.DOTS_PER_INCH = 40  # a coarse picture is made sooner

# Estimates scatter about the truth by 0.1, from a generator that the series itself seeds; options go in by a file.
STAND_IN = """#!/usr/bin/python3 -IS
import csv, json, pathlib, random, sys
options = json.loads(pathlib.Path(__file__).with_suffix(".json").read_text())
if "--version" in sys.argv:
    sys.exit(0)
if "fails" in options:
    sys.exit("lucy: " + options["fails"])
value = lambda name: sys.argv[sys.argv.index(name) + 1]
assert sys.argv[1] == "green-kubo" and [float(value(name)) for name in ("--volume", "--temperature")] == [1.0, 1.0]
with open(value("--from-series")) as file:
    rows = [row[value("--pxy")] + row[value("--difference")] for row in csv.DictReader(file)]
assert len(rows) == round(options["time"] / float(value("--interval")))
chance = random.Random(rows[0])
estimates = [options["truth"] + chance.gauss(0.0, 0.1) for _ in range(2)]
out = pathlib.Path(value("--out"))
out.mkdir()
(out / "viscosity.csv").write_text(
    "viscosity,viscosity_error,viscosity_spectrum,viscosity_spectrum_error\\n"
    f"{estimates[0]},{options['error']},{estimates[1]},{options['spectrum_error']}\\n")
"""


class Processes(unittest.TestCase):
    def test_the_correlation_is_the_sum_of_exponentials(self):
        interval, samples, count = 0.4, 200, 4000
        generator = np.random.default_rng(11)
        for variance, tau in ((0.55, 25.6), (0.05, 0.5)):
            rows = np.array([calibration.ornstein_uhlenbeck(variance, tau, samples, interval, generator)
                             for _ in range(count)])
            self.assertEqual(rows.shape, (count, samples))
            # From the first sample on, across the ends of blocks too.
            for first, second in ((0, 0), (0, 1), (63, 63), (63, 64), (62, 65), (0, 150), (64, 128), (199, 199)):
                products = rows[:, first] * rows[:, second]
                expected = variance * math.exp(-abs(second - first) * interval / tau)
                self.assertLess(abs(products.mean() - expected), 4 * products.std() / math.sqrt(count), (first, second))

    def test_columns_and_realisations_are_independent_and_repeatable(self):
        settings = types.SimpleNamespace(seed=3, time=2000.0, interval=0.2)
        first = calibration.series("two", 0, settings)
        self.assertEqual(first.shape, (10000, 2))
        np.testing.assert_array_equal(first, calibration.series("two", 0, settings))
        for other in (first[:, 1], calibration.series("two", 1, settings)[:, 0],
                      calibration.series("one", 0, settings)[:, 0]):
            product = np.mean(first[:, 0] * other) / first[:, 0].std() / other.std()
            self.assertLess(abs(product), 4 * math.sqrt(2 * 13.0 / settings.time))

    def test_truths_are_sums_of_variance_and_decay_time(self):
        self.assertAlmostEqual(calibration.truth("one"), 14.08, places=12)
        self.assertAlmostEqual(calibration.truth("two"), 0.545, places=12)

    def test_a_written_series_is_read_back_to_nine_digits(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "series.csv"
            values = np.array([[1.25, -3.0e-7], [-0.123456789, 41.0]])
            calibration.write_series(path, values)
            self.assertEqual(path.read_text(encoding="ascii").splitlines()[0], "pxy,difference")
            np.testing.assert_allclose(np.loadtxt(path, delimiter=",", skiprows=1), values, rtol=1e-9)


class Study(unittest.TestCase):
    REALISATIONS = 40

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="lucy_calibrate_green_kubo_test_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "lucy.py").write_text(STAND_IN, encoding="ascii")
        (self.folder / "lucy.py").chmod(0o755)

    def study(self, *arguments, error=0.1, spectrum_error=0.1, picture=False, **others):
        """Exit code, standard output and standard error; the picture is written only if asked for."""
        options = {"truth": 14.08, "time": 20, "error": str(error), "spectrum_error": str(spectrum_error)} | others
        (self.folder / "lucy.json").write_text(json.dumps(options), encoding="ascii")
        out, complaint = io.StringIO(), io.StringIO()
        command = ["calibrate_green_kubo.py", "--process", "one", "--realisations", str(self.REALISATIONS),
                   "--time", "20", "--lucy", str(self.folder / "lucy.py"), "--out", str(self.folder / "out"),
                   *arguments]
        with unittest.mock.patch.object(sys, "argv", command), contextlib.redirect_stdout(out), \
                contextlib.redirect_stderr(complaint), contextlib.ExitStack() as stack:
            if not picture:
                stack.enter_context(unittest.mock.patch.object(lucy_tables, "save"))
            try:
                code = calibration.main()
            except SystemExit as ended:
                code = ended.code
            calibration.plt.close("all")
        return code, out.getvalue(), complaint.getvalue()

    def rows(self):
        with open(self.folder / "out" / "calibration.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_honest_error_bars_pass_and_everything_is_written(self):
        code, out, complaint = self.study("--seed", "2", picture=True)
        self.assertEqual((code, complaint), (0, ""), out)
        lines = [line for line in out.splitlines() if line.startswith("| one")]
        self.assertEqual(len(lines), 2)
        rows = self.rows()
        self.assertEqual(len(rows), 2 * self.REALISATIONS)
        for line, estimator in zip(lines, ("integral", "spectrum")):
            found = [row for row in rows if row["estimator"] == estimator]
            within = sum(abs(float(row["value"]) - float(row["truth"])) <= float(row["error"]) for row in found)
            self.assertIn(f"| one | {estimator} | {self.REALISATIONS} | 0 | 14.08 |", line)
            self.assertIn(f"| {within / self.REALISATIONS:.3f}(74) |", line)
        self.assertTrue((self.folder / "out" / "calibration.png").read_bytes().startswith(b"\x89PNG"))
        self.assertTrue((self.folder / "out" / "calibration.svg").exists())

    def test_bars_too_short_too_long_or_unknown_for_either_estimator_do_not_pass(self):
        for errors in ({"error": 0.05}, {"spectrum_error": 0.05}, {"error": 0.25}, {"spectrum_error": "nan"}):
            with self.subTest(errors):
                code, out, complaint = self.study(**errors)
                self.assertEqual((code, complaint), (1, ""), out)
        self.assertIn(f"| one | spectrum | {self.REALISATIONS} | {self.REALISATIONS} | - |", out)

    def test_the_number_of_processes_changes_nothing(self):
        self.study("--processes", "1", "--realisations", "8")
        first = self.rows()
        self.study("--processes", "3", "--realisations", "8")
        self.assertEqual(self.rows(), first)
        self.study("--seed", "2", "--realisations", "8")
        self.assertNotEqual(self.rows(), first)

    def test_mistakes_and_a_program_that_fails_get_a_sentence(self):
        for code, says, arguments, options in (
                (1, "exit code 1: lucy: out of luck", (), {"fails": "out of luck"}),
                (2, "no-lucy is no program", ("--lucy", str(self.folder / "no-lucy")), {}),
                (2, "fewer than 100 samples", ("--time", "5"), {}),
                (2, "--seed must be", ("--seed", "-1"), {})):
            with self.subTest(says):
                result, _, complaint = self.study(*arguments, **options)
                self.assertEqual(result, code, complaint)
                self.assertIn(says, complaint)
                self.assertEqual(complaint.count("\n"), 1, complaint)


if __name__ == "__main__":
    unittest.main()

# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of Green-Kubo runs on small made-up tables: they appear, nothing is dropped in silence, unknown numbers and
failed states do no harm, mistakes get a sentence. Exit code 77 (skipped) without numpy and matplotlib."""

import contextlib
import io
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings

try:
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError:
    print("skipped: /usr/bin/python3 lacks numpy or matplotlib")
    sys.exit(77)

SCRIPTS = pathlib.Path(os.environ.get("LUCY_SOURCE_DIRECTORY", pathlib.Path(__file__).parents[2])) / "analysis"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True
import lucy_tables  # noqa: E402
import plot_green_kubo  # noqa: E402
import plot_viscosities  # noqa: E402

lucy_tables.DOTS_PER_INCH = 40  # coarse pictures are made sooner

QUANTITIES = ("viscosity", "viscosity_half_cutoff", "viscosity_spectrum", "decay_time", "shear_modulus")
VISCOSITY_COLUMNS = ("energy_per_particle", "particles",
                     *(name + suffix for name in QUANTITIES for suffix in ("", "_error")),
                     "cutoff", "decay_begin", "decay_end", "duration", "replicas", "status")
PUBLISHED = """particles,energy_per_particle,viscosity,total_time,pressure,pressure_kinetic
1024,0.5,0.548,20000,0.5562,0.071
1024,1,14.0,40000,1.024,0.539
"""
INPUT = """[system]
density = 1.0
[kernel]
name = "lucy"
range = 3.0
"""
NAN = math.nan


def csv_text(columns, rows):
    return "\n".join([",".join(columns)] + [",".join(map(str, row)) for row in rows]) + "\n"


class PictureTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="lucy_green_kubo_plots_test_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.reference = self.folder / "reference"
        self.reference.mkdir()
        self.write("reference/posch1995_green_kubo.csv", PUBLISHED)
        self.write("input.toml", INPUT)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def change(self, name, before, after):
        text = (self.folder / name).read_text(encoding="utf-8")
        self.assertIn(before, text)
        self.write(name, text.replace(before, after))

    def call(self, module, *arguments):
        """Exit code, standard output and standard error of a script's main(); a warning is an error."""
        name = f"{module.__name__}.py"
        out, error = io.StringIO(), io.StringIO()
        with unittest.mock.patch.object(sys, "argv", [name, str(self.folder), *map(str, arguments)]), \
                contextlib.redirect_stdout(out), contextlib.redirect_stderr(error), warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                code = module.main() or 0
            except SystemExit as ended:
                code = ended.code
            module.plt.close("all")
        return code, out.getvalue(), error.getvalue()

    def draw(self, module, *arguments):
        """What is said on the terminal."""
        code, out, error = self.call(module, *arguments)
        self.assertEqual((code, error), (0, ""), out)
        return out

    def refused(self, module, *says, code=2, arguments=()):
        result, _, error = self.call(module, *arguments)
        self.assertEqual(result, code, error)
        self.assertEqual(error.count("\n"), 1, error)
        for piece in says:
            self.assertIn(piece, error)

    def texts(self, stem):
        """The texts of a picture, which matplotlib keeps as comments; the PNG beside it is one."""
        self.assertTrue((self.folder / f"{stem}.png").read_bytes().startswith(b"\x89PNG"))
        drawing = (self.folder / f"{stem}.svg").read_text(encoding="utf-8")
        self.assertIn("</svg>", drawing)
        return re.findall(r"<!-- (.*?) -->", drawing)


class CorrelationPicture(PictureTest):
    def setUp(self):
        super().setUp()
        self.rows = [self.row(1, 13.6, 25.6)]
        self.curves = [(1, ((0.527, 25.6),))]
        self.tables()

    def add_low_energy(self):
        self.rows.insert(0, self.row(0.5, 0.545, 13.0))
        self.curves.insert(0, (0.5, ((0.05, 0.5), (0.04, 13.0))))
        self.tables()

    @staticmethod
    def row(energy, viscosity, tau, status="ok"):
        return (energy, 1024, viscosity, 0.03 * viscosity, 0.97 * viscosity, NAN, 0.98 * viscosity, 0.03 * viscosity,
                tau, 0.02 * tau, 0.1, 0.001, 6 * tau, 0.5 * tau, 3 * tau, 5000.0, 4, status)

    def tables(self, unknown=(), times=None):
        """Writes both; columns named in `unknown` hold nan."""
        self.write("viscosity.csv", csv_text(VISCOSITY_COLUMNS, self.rows))
        columns = ("point",) + plot_green_kubo.STATE + plot_green_kubo.COLUMNS
        rows = []
        points = {row[0]: point for point, row in enumerate(self.rows, 1)}
        for energy, parts in self.curves:
            for time in np.linspace(0, 20 * parts[-1][1], 81) if times is None else times:
                decay = sum(variance * math.exp(-time / tau) for variance, tau in parts)
                integral = sum(variance * tau * -math.expm1(-time / tau) for variance, tau in parts)
                cells = {"point": points[energy], "energy_per_particle": energy, "particles": 1024, "time": time,
                         "C_mean": decay + 0.002 * math.sin(time), "C_mean_error": 0.002, "C_kinetic": 1.1 * decay,
                         "C_cross": -0.2 * decay, "C_potential": 0.1 * decay, "integral": integral,
                         "integral_error": 0.02 * integral, "noise_integral": 0.01 * math.sin(time / 20),
                         "noise_envelope": 0.01 * math.sqrt(time)}
                rows.append([NAN if column in unknown else cells.get(column, 0.001) for column in columns])
        self.write("correlation.csv", csv_text(columns, rows))

    def draw_correlation(self, *arguments):
        return self.draw(plot_green_kubo, *arguments, "--reference", self.reference)

    def test_every_state_has_its_panels_with_the_published_value_beside_ours(self):
        self.add_low_energy()
        self.assertEqual(self.draw_correlation(), "")
        texts = self.texts("correlation")
        self.assertEqual([text for text in texts if text.startswith("$E/N")],
                         ["$E/N = 0.5$, $N = 1024$", "$E/N = 1$, $N = 1024$"])
        for label in ("integral", "spectrum", "published"):
            self.assertEqual(texts.count(label), 2, label)
        self.assertEqual(texts.count("NEMD"), 0)
        self.assertIn(r"$\eta$ = 13.60(41) at the cut-off, 13.33(41) from the spectrum", texts)
        self.assertIn("potential part", texts)
        self.assertIn(r"$\tau$ = 25.60(51)", texts)
        first = (self.folder / "correlation.svg").read_bytes()
        self.draw_correlation()
        self.assertEqual((self.folder / "correlation.svg").read_bytes(), first, "the same tables, another picture")

    def test_nemd_values_are_drawn_where_they_are_known(self):
        self.add_low_energy()
        self.write("nemd.csv", "particles,energy_per_particle,viscosity,viscosity_error\n1024,1,13.1,0.2\n")
        self.assertEqual(self.draw_correlation("--nemd", self.folder / "nemd.csv"), "")
        self.assertEqual(self.texts("correlation").count("NEMD"), 1)

    def test_published_values_stand_beside_runs_under_their_conditions_only(self):
        for before, after, said in (("density = 1.0", "density = 0.8", "density = 0.8"),
                                    ('"lucy"', '"monaghan"', "kernel name = monaghan"),
                                    ("range = 3.0", "range = 4.0", "kernel range = 4.0"),
                                    ("range = 3.0", "range = 3.0\n[[point]]\nrange = 6.0", "kernel range = 6.0"),
                                    ("range = 3.0", "range =", "conditions unknown")):
            with self.subTest(after):
                self.write("input.toml", INPUT)
                self.change("input.toml", before, after)
                self.assertEqual(plot_green_kubo.differing_conditions(self.folder), [said])
        self.assertIn("published values are left out: no readable input.toml", self.draw_correlation())
        self.assertNotIn("published", self.texts("correlation"))

    def test_a_published_value_is_that_of_the_same_state(self):
        self.change("viscosity.csv", "\n1,1024,", "\n1,400,")
        self.assertEqual(self.draw_correlation(), "")
        self.assertIn("integral", self.texts("correlation"))
        self.assertNotIn("published", self.texts("correlation"))

    def test_without_a_file_of_published_values_there_are_none(self):
        (self.reference / "posch1995_green_kubo.csv").unlink()
        self.assertEqual(self.draw_correlation(), "")
        self.assertNotIn("published", self.texts("correlation"))

    def test_the_bar_of_a_published_value_is_ours_scaled_to_its_run_and_the_rounding_of_print(self):
        row = {"energy_per_particle": 1.0, "particles": 1024.0, "viscosity_error": 0.3, "duration": 20000.0,
               "replicas": 8.0}
        values = plot_green_kubo.published_values(self.reference / "posch1995_green_kubo.csv", [row], self.folder, [])
        self.assertEqual(values[0][0], 14.0)
        self.assertAlmostEqual(values[0][1], math.hypot(0.3 * 2, 0.1 / math.sqrt(12)), places=12)

    def test_a_failed_state_is_named_and_the_others_are_drawn(self):
        self.rows.append((0.5, 1024, *[NAN] * 15, "failed"))
        self.tables()
        self.assertEqual(self.draw_correlation(),
                         "correlation plot: E/N = 0.5, N = 1024: no correlation function (status failed)\n")
        self.assertEqual(sum(text.startswith("$E/N") for text in self.texts("correlation")), 1)

    def test_nothing_to_draw_is_said_and_leaves_no_picture(self):
        self.rows = [(1, 1024, *[NAN] * 15, "failed")]
        self.curves = []
        self.tables()
        self.assertIn("not drawn", self.draw_correlation())
        self.assertFalse((self.folder / "correlation.png").exists())

    def test_unknown_numbers_do_no_harm(self):
        self.tables(unknown=[column for column in plot_green_kubo.COLUMNS if column not in ("time", "C_mean")])
        self.draw_correlation()
        self.assertNotIn("potential part", self.texts("correlation"))
        for known in (0, 2, 12):  # how many cells at the start of the row are numbers
            with self.subTest(known=known):
                row = self.row(1, 13.6, 25.6)
                self.rows = [(*row[:2 + known], *[NAN] * (15 - known), "short")]
                self.tables()
                self.draw_correlation()
        texts = self.texts("correlation")
        self.assertIn("published", texts)
        self.assertIn(r"$\eta$ = 13.60(41) at the cut-off, 13.33(41) from the spectrum", texts)
        self.assertIn("cut-off", texts)
        self.assertNotIn("exponential tail", texts)  # the end of its window is unknown

    def test_times_may_be_spaced_in_levels(self):
        self.tables(times=[*range(16), *(base * step for base in (2, 4, 8, 16, 32) for step in range(8, 16))])
        self.assertEqual(self.draw_correlation(), "")

    def test_a_series_from_elsewhere_has_no_state_and_no_units(self):
        for name in ("correlation.csv", "viscosity.csv"):
            lines = (self.folder / name).read_text(encoding="utf-8").splitlines()
            kept = [lines[0]] + [re.sub(r"^1,1024,", "0,0,", line) for line in lines[1:]]
            self.write(name, "\n".join(kept) + "\n")
        self.assertEqual(self.draw_correlation(), "")
        texts = self.texts("correlation")
        self.assertIn("sampled series", texts)
        self.assertFalse([text for text in texts if "sigma" in text])

    def test_the_tail_is_found_again(self):
        time = np.linspace(0, 100, 401)
        curves = {"time": time, "C_mean": 0.04 * np.exp(-time / 13), "C_mean_error": np.full(401, 0.001)}
        row = {"decay_begin": 6.5, "decay_end": 39.0, "decay_time": 13.0}
        self.assertAlmostEqual(plot_green_kubo.tail_amplitude(row, curves), 0.04, places=12)
        self.assertTrue(math.isnan(plot_green_kubo.tail_amplitude(row | {"decay_time": NAN}, curves)))

    def test_mistakes_get_a_sentence(self):
        module = plot_green_kubo
        self.change("viscosity.csv", ",13.6,", ",many,")
        self.refused(module, 'viscosity.csv: viscosity is "many" where a number was expected')
        self.tables()
        self.change("correlation.csv", "noise_envelope", "noise")
        self.refused(module, "correlation.csv: the header has no column noise_envelope")
        (self.folder / "correlation.csv").unlink()
        self.refused(module, f"cannot read {self.folder / 'correlation.csv'}")
        self.write("viscosity.csv", csv_text(VISCOSITY_COLUMNS, []))
        self.refused(module, "viscosity.csv has no rows")
        self.tables()
        self.refused(module, "nemd.csv", arguments=("--nemd", self.folder / "nemd.csv"))


class ViscositiesPicture(PictureTest):
    def setUp(self):
        super().setUp()
        self.routes = [(1024, energy, route, value, 0.02 * value, NAN, '"a note, with a comma"')
                       for energy, value in ((0.5, 0.59), (1, 13.5)) for route in plot_viscosities.ROUTES]
        fit = (13.0, 0.4, -100.0, 900.0, -250.0)
        self.sheared = [(1024, 1, 0.001, 12.7, 0.5, "fitted", *fit), (1024, 1, -0.002, 13.2, 0.4, "fitted", *fit),
                        (1024, 1, 0.005, 13.0, 0.2, "fitted", *fit), (1024, 1, 0.009, 11.0, 7.0, "unstable", *fit),
                        (1024, 1, 0.02, 8.85, 0.06, "beyond", *fit), (1024, 1, 0.1, 2.64, NAN, "no-error", *fit)]

    def tables(self):
        self.write("viscosities.csv", csv_text(
            ("particles", "energy_per_particle", "route", "viscosity", "viscosity_error", "z", "note"), self.routes))
        self.write("sweep_fit.csv", csv_text(
            ("particles", "energy_per_particle", "strain_rate", "viscosity", "viscosity_error", "part",
             *plot_viscosities.FIT), self.sheared))

    def draw_viscosities(self):
        self.tables()
        return self.draw(plot_viscosities)

    def test_every_route_and_every_rate_is_there(self):
        self.assertEqual(self.draw_viscosities(), "")
        texts = self.texts("viscosities")
        for label, *_ in plot_viscosities.ROUTES.values():
            self.assertEqual(texts.count(label), 2, label)
        for label in ("sheared, fitted", "sheared, left out", "one particle has much of $K$", "no sheared runs"):
            self.assertEqual(texts.count(label), 1, label)
        first = (self.folder / "viscosities.svg").read_bytes()
        self.draw_viscosities()
        self.assertEqual((self.folder / "viscosities.svg").read_bytes(), first)

    def test_what_is_unknown_is_named_and_does_no_harm(self):
        unknown = ("nemd", "published-green-kubo")
        self.routes = [row[:3] + (NAN, NAN) + row[5:] if row[1] == 1 and row[2] in unknown else row
                       for row in self.routes]
        self.sheared = [row[:6] + (NAN,) * 5 for row in self.sheared]
        self.sheared[0] = self.sheared[0][:3] + (NAN, NAN, "no-error") + (NAN,) * 5
        said = self.draw_viscosities()
        self.assertIn("E/N = 1, N = 1024: no value for NEMD, zero rate, published\n", said)
        self.assertIn("E/N = 1, N = 1024: no viscosity at strain rate 0.001\n", said)
        self.assertEqual(self.texts("viscosities").count("NEMD, zero rate"), 1)

    def test_nothing_to_draw_is_said_and_leaves_no_picture(self):
        self.routes = [row[:3] + (NAN, NAN) + row[5:] for row in self.routes]
        self.sheared = []
        self.assertIn("not drawn", self.draw_viscosities())
        self.assertFalse((self.folder / "viscosities.png").exists())

    def test_mistakes_get_a_sentence(self):
        self.tables()
        self.change("viscosities.csv", ",nemd,", ",nmed,")
        self.refused(plot_viscosities, 'route is "nmed" where one of nemd, green-kubo')
        self.tables()
        self.change("sweep_fit.csv", "beyond", "above")
        self.refused(plot_viscosities, 'part is "above" where one of fitted, beyond')
        (self.folder / "sweep_fit.csv").unlink()
        self.refused(plot_viscosities, "cannot read", "sweep_fit.csv")


class Helpers(unittest.TestCase):
    def test_errors_have_two_digits_in_units_of_the_last(self):
        for value, error, text in ((13.5204, 0.4123, "13.52(41)"), (0.59, 0.0098, "0.5900(98)"),
                                   (0.59, 0.00996, "0.590(10)"),
                                   (10.26, 3.41, "10.3(3.4)"), (712.4, 77.2, "712(77)"), (8.85, 0.999, "8.8(1.0)"),
                                   (13.52, NAN, "13.52"), (NAN, 0.1, "unknown"), (-0.09, 0.13, "-0.09(13)")):
            self.assertEqual(lucy_tables.with_error(value, error), text)

    def test_unstable_neighbours_share_a_band_that_ends_midway_to_stable_rates(self):
        bands = lucy_tables.instability_bands({0.01: True, 0.005: False, 0.02: True, 0.08: False, 0.5: True})
        self.assertEqual(len(bands), 2)
        for found, expected in zip(bands[0] + bands[1], (math.sqrt(5e-5), 0.04, 0.2, 0.55)):
            self.assertAlmostEqual(found, expected, places=12)

    def test_a_python_without_the_libraries_gets_a_sentence(self):
        with tempfile.TemporaryDirectory() as broken:
            (pathlib.Path(broken) / "matplotlib.py").write_text("raise ImportError('not here')\n", encoding="ascii")
            for script in ("plot_green_kubo.py", "plot_viscosities.py", "calibrate_green_kubo.py"):
                ended = subprocess.run([sys.executable, "-B", SCRIPTS / script, "."], capture_output=True, text=True,
                                       env={**os.environ, "PYTHONPATH": broken}, check=False)
                self.assertEqual(ended.returncode, 1)
                self.assertEqual(ended.stderr,
                                 f"{script} needs numpy and matplotlib (Debian: python3-matplotlib): not here\n")


if __name__ == "__main__":
    unittest.main()

# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of decaying waves on small made-up tables: points are grouped by the one setting in which they differ,
nothing is dropped in silence, unknown numbers and failed points do no harm, mistakes get a sentence. Exit code 77
(skipped) without numpy and matplotlib."""

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
import plot_waves  # noqa: E402

lucy_tables.DOTS_PER_INCH = 40  # coarse pictures are made sooner

NAN = math.nan
BASE = {"particles": 4096, "density": 1, "reading": "spam", "energy_per_particle": NAN, "kernel": "lucy", "range": 3,
        "equation_of_state": "ideal-gas", "temperature": 1, "viscosity": 0.3, "bulk_viscosity": 0, "conductivity": 0,
        "density_mean": "geometric", "disorder": 0.3, "noise": 0, "uniform": "temperature", "amplitude": 0.05,
        "mode": 1}
ATOMS = {"reading": "md", "energy_per_particle": 1, "equation_of_state": "none", "temperature": NAN, "viscosity": NAN,
         "bulk_viscosity": NAN, "conductivity": NAN, "density_mean": "none", "disorder": NAN, "noise": NAN,
         "uniform": "none", "prescribed": NAN}


class WavePictures(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="lucy_wave_plots_test_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.points = []
        for change in ({}, {"viscosity": 0.1}, {"viscosity": 0}, {"range": 5}, {"kernel": "monaghan"},
                       {"disorder": 0, "noise": 1e-6}, {"disorder": 0.1},
                       {"viscosity": 0, "disorder": 0, "noise": 0.1}, ATOMS, ATOMS | {"particles": 1024, "mode": 2},
                       ATOMS | {"energy_per_particle": 0.5}):
            self.add(change)

    def add(self, change, status="ok"):
        point = BASE | change
        k = 2 * math.pi * point["mode"] / math.sqrt(point["particles"])
        law = point["viscosity"] if "prescribed" not in change else change["prescribed"]
        value = (law if math.isfinite(law) else 5.0) + 0.2
        point |= {"prescribed": law, "wave_vector": k, "imposed_amplitude": point["amplitude"], "operator": law,
                  "pressure_forces": 0.15, "carried": 0.05, "total": value, "integral": value, "yield_stress": 0.001,
                  "status": status}
        for name in ("operator", "pressure_forces", "carried", "total", "integral", "yield_stress"):
            point[name + "_error"] = 0.02 * value
        self.points.append(point)

    def write(self, name, columns, rows):
        text = "\n".join([",".join(columns)] + [",".join(map(str, row)) for row in rows]) + "\n"
        (self.folder / name).write_text(text, encoding="utf-8")

    def tables(self, stem="shear_wave", rest="pressure_forces"):
        columns = list(self.points[0])
        self.write(f"{stem}.csv", [rest + column[15:] if column.startswith("pressure_forces") else column
                                   for column in columns], [[p[c] for c in columns] for p in self.points])
        curves, local = [], []
        for number, point in enumerate(self.points, 1):
            if point["status"] == "failed":
                continue
            scale = point["total"] * point["wave_vector"]**2
            for time in np.linspace(0, 3 / scale, 31):
                a = point["amplitude"] * math.exp(-scale * time)
                curves.append([number, time, a, 0.001, a, -point["operator"] / point["total"] * scale * a, 0, 0.001])
            for a in (0.04, 0.02):
                local.append([number, point["wave_vector"] * a, 1e-4, point["total"], 0.02, 0.001 * number, 1e-5])
        self.write("amplitude.csv", ["point", *plot_waves.CURVES, "particle_noise"], curves)
        self.write("local.csv", ["point", *plot_waves.LOCAL], local)

    def change(self, name, before, after):
        path = self.folder / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(before, text)
        path.write_text(text.replace(before, after), encoding="utf-8")

    def call(self, *arguments):
        """Exit code, standard output and standard error of the script's main(); a warning is an error."""
        out, error = io.StringIO(), io.StringIO()
        with unittest.mock.patch.object(sys, "argv", ["plot_waves.py", str(self.folder), *map(str, arguments)]), \
                contextlib.redirect_stdout(out), contextlib.redirect_stderr(error), warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                code = plot_waves.main() or 0
            except SystemExit as ended:
                code = ended.code
            plot_waves.plt.close("all")
        return code, out.getvalue(), error.getvalue()

    def draw(self, *arguments):
        code, out, error = self.call(*arguments)
        self.assertEqual((code, error), (0, ""), out)
        return out

    def refused(self, *says, arguments=()):
        code, _, error = self.call(*arguments)
        self.assertEqual(code, 2, error)
        self.assertEqual(error.count("\n"), 1, error)
        for piece in says:
            self.assertIn(piece, error)

    def texts(self, stem):
        """The texts of a picture, which matplotlib keeps as comments; the PNG beside it is one."""
        self.assertTrue((self.folder / f"{stem}.png").read_bytes().startswith(b"\x89PNG"))
        return re.findall(r"<!-- (.*?) -->", (self.folder / f"{stem}.svg").read_text(encoding="utf-8"))

    def test_points_that_differ_in_one_setting_share_a_panel(self):
        self.tables()
        self.assertEqual(self.draw(), "")
        texts = self.texts("amplitudes")
        for title in ("viscosity", "range", "weight function", "disorder of the start", "others", "atoms, $E/N = 1$",
                      "atoms, $E/N = 0.5$"):
            self.assertEqual(texts.count(title), 1, title)
        # The inviscid hot lattice differs from all others in more than one setting; the cold one counts as at rest.
        self.assertEqual(texts.count("disorder 0"), 1)
        self.assertIn(r"$\eta = 0$, disorder 0, noise 0.1", texts)
        self.assertIn("$N = 1024$, mode 2", texts)
        first = (self.folder / "amplitudes.svg").read_bytes()
        self.draw()
        self.assertEqual((self.folder / "amplitudes.svg").read_bytes(), first, "the same tables, another picture")

    def test_every_point_has_its_bar_and_atoms_their_wave_vectors(self):
        self.tables()
        self.write("viscosity.csv", ["energy_per_particle", "particles", "viscosity", "viscosity_error"],
                   [[1, 1024, 13.5, 0.4], [2, 1024, 40, 1]])
        self.assertEqual(self.draw("--green-kubo", self.folder), "")
        texts = self.texts("shear_wave")
        for label in ("as stated", r"$\eta = 0.1$", "$h = 5$", "monaghan", "disorder 0.1", "pressure forces", "others",
                      "atoms, $E/N = 1$, $N = 4096$", "atoms, $E/N = 1$, $N = 1024$, mode 2",
                      "$E/N = 1$, Green-Kubo", "$E/N = 0.5$, waves", "$A = 0.05$"):
            self.assertEqual(texts.count(label), 1, label)
        self.assertNotIn("$E/N = 0.5$, Green-Kubo", texts)

    def test_the_stress_of_pressure_forces_is_what_the_other_parts_leave(self):
        self.tables()
        base = plot_waves.read_points(self.folder, plot_waves.OF_SHEAR)[0]
        strain, stress, error = plot_waves.pressure_stress(base)
        # nu of pressure forces times the strain rate k a, and k int a dt = (k A - k a)/(k^2 nu), of a made-up wave
        k, nu = base.values["wave_vector"], base.values["total"]
        rates = k * base.values["imposed_amplitude"] - k**2 * nu * strain
        np.testing.assert_allclose(stress, (nu - base.values["operator"]) * rates, rtol=0.01)
        self.assertTrue(np.all(rates > 0.04 * rates[0]))
        self.assertTrue(np.all(error > 0))

    def test_temperature_waves_have_parts_of_their_own(self):
        self.points = self.points[:5]
        for point in self.points:
            del point["reading"], point["energy_per_particle"]
        self.tables("temperature_wave", "heating")
        self.assertEqual(self.draw(), "")
        texts = self.texts("temperature_wave")
        self.assertIn("heating", texts)
        self.assertIn("conduction operator", texts)
        self.assertFalse([text for text in texts if "yield" in text])

    def test_a_failed_point_is_named_and_the_others_are_drawn(self):
        self.add({"viscosity": 1}, status="failed")
        self.tables()
        self.assertEqual(self.draw(), "wave plots: point 12 has no curve (status failed)\n")
        self.assertNotIn(r"$\eta = 1$", self.texts("shear_wave"))
        self.points = [point | {"status": "failed"} for point in self.points[:1]]
        self.tables()
        self.assertIn("not drawn", self.draw())

    def test_unknown_numbers_do_no_harm(self):
        for point in self.points:
            point |= dict.fromkeys(("integral", "integral_error", "total_error", "yield_stress", "yield_stress_error"),
                                   NAN)
        self.points[0] |= {"operator": NAN, "total": NAN, "pressure_forces": NAN, "carried": NAN}
        self.tables()
        self.change("amplitude.csv", ",0.001,", ",nan,")
        self.change("local.csv", ",0.02,", ",nan,")
        self.assertEqual(self.draw(), "")
        self.points = self.points[8:9]  # atoms alone
        self.tables()
        self.assertEqual(self.draw(), "")

    def test_mistakes_get_a_sentence(self):
        self.tables()
        self.change("shear_wave.csv", ",0.001,", ",many,")
        self.refused('shear_wave.csv: yield_stress is "many" where a number was expected')
        self.tables()
        self.change("amplitude.csv", "amplitude_error", "spread")
        self.refused("amplitude.csv: the header has no column amplitude_error")
        (self.folder / "local.csv").unlink()
        self.tables()
        (self.folder / "local.csv").unlink()
        self.refused("cannot read", "local.csv")
        self.tables()
        self.refused("viscosity.csv", arguments=("--green-kubo", self.folder))
        (self.folder / "shear_wave.csv").unlink()
        self.refused("cannot read", "shear_wave.csv")

    def test_a_python_without_the_libraries_gets_a_sentence(self):
        (self.folder / "matplotlib.py").write_text("raise ImportError('not here')\n", encoding="ascii")
        ended = subprocess.run([sys.executable, "-B", SCRIPTS / "plot_waves.py", "."], capture_output=True, text=True,
                               env={**os.environ, "PYTHONPATH": str(self.folder)}, check=False)
        self.assertEqual(ended.returncode, 1)
        self.assertEqual(ended.stderr,
                         "plot_waves.py needs numpy and matplotlib (Debian: python3-matplotlib): not here\n")


if __name__ == "__main__":
    unittest.main()

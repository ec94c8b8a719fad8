# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""analysis/benard_rates.py on flows whose strain rates are known."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SCRIPT = pathlib.Path(os.environ["LUCY_SOURCE_DIRECTORY"]) / "analysis" / "benard_rates.py"


def centres(length, cells):
    return (np.arange(cells) + 0.5) * length / cells - length / 2


class BenardRates(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "point_001.h5"

    def run_script(self):
        return subprocess.run([sys.executable, str(SCRIPT), str(self.path)], capture_output=True, text=True, check=False)

    def write(self, u, v, side, cells=(80, 40)):
        x, y = np.meshgrid(centres(2.0, cells[0]), centres(1.0, cells[1]))
        with h5py.File(self.path, "w") as file:
            file.create_group("parameters").attrs["side"] = side
            file["grid/x"], file["grid/y"] = x[0], y[:, 0]
            file["fields/velocity_x"], file["fields/velocity_y"] = u(x, y), v(x, y)

    def numbers(self):
        process = self.run_script()
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return [float(cell) for cell in process.stdout.splitlines()[1].split()[1:]]

    def test_a_shear_wave_between_floor_and_ceiling(self):
        # v_x = sin(2 pi y) vanishes at y = -1/2 and 1/2: the rate is 2 pi |cos(2 pi y)|, of mean 4 and mean square 2 pi^2
        self.write(lambda x, y: np.sin(2 * np.pi * y), lambda x, y: 0 * x, "periodic")
        for found, true in zip(self.numbers(), (4.0, 2**0.5 * np.pi, 2 / np.pi**2)):
            self.assertAlmostEqual(found, true, delta=0.01 * true + 0.005)  # as printed

    def test_an_extension_along_periodic_sides(self):
        # v_x = sin(pi x) cos(pi y): d v_x/d x = pi cos cos and d v_x/d y = -pi sin sin, mean square pi^2/2
        self.write(lambda x, y: np.sin(np.pi * x) * np.cos(np.pi * y), lambda x, y: 0 * x, "periodic")
        self.assertAlmostEqual(self.numbers()[1], np.pi / 2**0.5, delta=0.02)

    def test_side_walls(self):
        # v_y = sin(pi x) vanishes at x = -1, 0, 1
        self.write(lambda x, y: 0 * x, lambda x, y: np.sin(np.pi * x) * np.cos(np.pi * y), "walls")
        self.assertAlmostEqual(self.numbers()[1], np.pi / 2**0.5, delta=0.02)

    def test_another_file_is_refused_by_a_sentence(self):
        self.path.write_text("no HDF5", encoding="utf-8")
        process = self.run_script()
        self.assertEqual(process.returncode, 2)
        self.assertIn("point_001.h5", process.stderr)
        self.assertNotIn("Traceback", process.stderr)


if __name__ == "__main__":
    unittest.main()

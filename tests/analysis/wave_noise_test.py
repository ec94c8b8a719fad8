# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""analysis/wave_noise.py on made-up waves whose added viscosity is known."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["LUCY_SOURCE_DIRECTORY"]) / "analysis" / "wave_noise.py"


class WaveNoise(unittest.TestCase):
    def test_a_power_law_is_interpolated_exactly_and_nothing_is_extrapolated(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "shear_wave.csv").write_text("operator\n0.3\n0.1\n", encoding="utf-8")
            lines = ["point,particle_noise,diffusivity,diffusivity_error"]
            for noise in (0.004, 0.0016, 0.0006):  # 0.0002/noise beyond the operator
                lines.append(f"1,{noise},{0.3 + 0.0002 / noise},{0.00002 / noise}")
            (folder / "local.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
            process = subprocess.run([sys.executable, str(SCRIPT), name], capture_output=True, text=True, check=False)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        header, row = process.stdout.rstrip("\n").split("\n")  # the second point has no windows
        self.assertEqual(header.split(), ["point", "0.002", "0.001", "0.0005", "0.0003"])
        cells = row.replace("+-", " ").split()
        self.assertEqual((cells[0], cells[1], cells[3]), ("1", "0.100", "0.200"))
        self.assertEqual(len(cells), 5)  # 0.0005 and 0.0003 lie beyond the windows
        for error, value in ((cells[2], 0.1), (cells[4], 0.2)):
            self.assertGreater(float(error), 0.05 * value)  # 10 % in each window, less between two
            self.assertLessEqual(float(error), 0.1 * value)


if __name__ == "__main__":
    unittest.main()

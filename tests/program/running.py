# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the program share: a scratch folder, a tiny input, and the program run in that folder."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["LUCY_PROGRAM"]
SOURCE = pathlib.Path(os.environ["LUCY_SOURCE_DIRECTORY"])

TINY = """\
title = "two tiny points"
[system]
particles = 36
energy_per_particle = 1
[shear]
strain_rate = [0.5, 1]
[run]
equilibration = 3
duration = 60
replicas = 2
"""


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="lucy_program_test_")
        self.folder = pathlib.Path(self._folder.name)
        self.addCleanup(self._folder.cleanup)
        self._modules = tempfile.TemporaryDirectory(prefix="lucy_program_test_modules_")
        self.addCleanup(self._modules.cleanup)
        self.write("tiny.toml", TINY)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def environment(self, pictures=False, **changes):
        """Drawing takes longer than all else here: without `pictures` no Python of the program's can import numpy."""
        modules = pathlib.Path(self._modules.name)
        (modules / "numpy.py").write_text("raise ImportError('not in this test')\n")
        hiding = {} if pictures else {"PYTHONPATH": str(modules)}
        return {**os.environ, "MPLCONFIGDIR": str(modules), **hiding, **changes}

    def lucy(self, *arguments, environment=None, **options):
        """The finished process of `lucy ARGUMENTS`, run in the scratch folder."""
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=300, env=environment or self.environment(), **options)

    def start(self, *arguments, **options):
        return subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                env=self.environment(), **options)

    def expect(self, process, code, *says):
        """The exit code; on failure, one to three lines on standard error that hold all of `says`."""
        text = f"{process.args}\n{process.stdout}\n{process.stderr}"
        self.assertEqual(process.returncode, code, text)
        for piece in says:
            self.assertIn(piece, process.stderr, text)
        if code != 0:
            lines = process.stderr.rstrip("\n").split("\n")
            self.assertLessEqual(len(lines), 3, text)
            self.assertTrue(lines[0].startswith("lucy: "), text)

    def sweep(self, *arguments, code=0, says=(), **options):
        process = self.lucy("sweep", *arguments, **options)
        self.expect(process, code, *says)
        return process

    def entries(self, name="."):
        return sorted(entry.name for entry in (self.folder / name).iterdir())

    def contents(self, directory, names=("table.csv", "replicas.csv")):
        return {name: (self.folder / directory / name).read_bytes() for name in names}

    def rows(self, directory):
        with open(self.folder / directory / "table.csv", newline="") as file:
            return list(csv.DictReader(file))

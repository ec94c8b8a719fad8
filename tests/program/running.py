# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the program share: a scratch folder, a tiny input, the program run in that folder, and what every
command that runs an input promises."""

import csv
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
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


class CommandTest(ProgramTest):
    """Of one command that runs an input, small.toml."""

    COMMAND = None
    KIND = None  # as messages call it, "Green-Kubo run"
    SMALL = None
    RESULTS = ()  # files that nothing but the input may change, first the table

    def setUp(self):
        super().setUp()
        self.write("small.toml", self.SMALL)

    def run_input(self, *arguments, command=None, code=0, says=(), **options):
        process = self.lucy(command or self.COMMAND, *arguments, **options)
        self.expect(process, code, *says)
        return process

    def results(self, directory):
        return self.contents(directory, self.RESULTS)

    def table(self, directory, name=None):
        with open(self.folder / directory / (name or self.RESULTS[0]), newline="") as file:
            return list(csv.DictReader(file))

    def expect_refusals(self, *refusals):
        """Of small.toml with a setting each: pairs of the setting and what is said of it."""
        for setting, says in refusals:
            with self.subTest(setting):
                self.run_input("small.toml", "--out", "x", "--set", setting, code=2, says=("--set", says))
                self.assertFalse((self.folder / "x").exists())


class CommandPromises:
    """Tests that every CommandTest inherits beside its own. LONGER is an input for a second or so of work, with EXTRA
    arguments; PRINTED_AGAIN are the arguments of a run that is short."""

    LONGER = None
    EXTRA = ()
    OTHER = "run.seed=5"  # another input
    PRINTED_AGAIN = ()
    LONGEST_WAIT = 0.15  # between kills, as a part of the whole

    def test_nothing_depends_on_the_number_of_threads(self):
        self.run_input("small.toml", "--out", "one", "--set", "run.threads=1")
        self.run_input("small.toml", "--out", "three", "--set", "run.threads=3")
        self.assertEqual(self.results("one"), self.results("three"))

    def test_a_finished_run_is_printed_again(self):
        first = self.run_input("small.toml", "--out", "x", *self.PRINTED_AGAIN)
        again = self.run_input("small.toml", "--out", "x", *self.PRINTED_AGAIN)
        self.assertIn("nothing was run", again.stdout)
        self.assertEqual(first.stdout.split("\nTook")[0], again.stdout.split(f"\nThis {self.KIND} was")[0])

    def test_a_directory_of_something_else_is_left_alone(self):
        self.run_input("small.toml", "--out", "x", *self.PRINTED_AGAIN)
        before = self.results("x")
        self.run_input("small.toml", "--out", "x", *self.PRINTED_AGAIN, "--set", self.OTHER, code=2,
                       says=("x", "another input"))
        self.assertEqual(self.results("x"), before)
        (self.folder / "y").mkdir()
        (self.folder / "y" / "thesis.tex").write_text("x")
        self.run_input("small.toml", "--out", "y", code=2, says=("thesis.tex", f"no {self.KIND}"))
        self.assertEqual(self.entries("y"), ["thesis.tex"])

    def test_killed_again_and_again_it_ends_with_the_same_bits(self):
        self.write("longer.toml", self.LONGER)
        begin = time.monotonic()
        self.run_input("longer.toml", "--out", "whole", *self.EXTRA)
        seconds = time.monotonic() - begin
        moments = random.Random(3)
        kills = 0
        for _ in range(60):
            process = self.start(self.COMMAND, "longer.toml", "--out", "x", *self.EXTRA)
            time.sleep(moments.uniform(0.06, 0.06 + self.LONGEST_WAIT * seconds))
            process.kill()
            process.wait()
            process.stderr.close()
            if process.returncode == 0:
                break
            kills += 1
        self.run_input("longer.toml", "--out", "x", *self.EXTRA)
        self.assertGreaterEqual(kills, 3)
        self.assertEqual(self.results("x"), self.results("whole"))
        self.assertNotIn("checkpoints", self.entries("x"))


def main_with_lammps():
    """Runs the tests of a script that needs LAMMPS, or says that it is skipped."""
    if shutil.which("lmp") is None:
        print("skipped: no LAMMPS")
        sys.exit(77)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main(verbosity=2)

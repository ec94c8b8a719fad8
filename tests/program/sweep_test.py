# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sweep writes: tables that do not depend on threads, series and frames in H5MD, pictures, a record; points that
fail; what is shown on a terminal."""

import csv
import json
import math
import os
import pty
import re
import subprocess
import unittest

from running import PROGRAM, ProgramTest

try:
    import h5py
except ImportError:
    h5py = None


class Results(ProgramTest):
    def test_nothing_depends_on_the_number_of_threads(self):
        self.sweep("tiny.toml", "--out", "one", "--set", "run.threads=1")
        self.sweep("tiny.toml", "--out", "three", "--set", "run.threads=3")
        names = ("table.csv", "replicas.csv", "input.toml", "notes.txt", "point_001.h5", "point_002.h5")
        self.assertEqual(self.contents("one", names), self.contents("three", names))

    def test_a_large_system_with_all_threads_inside_has_the_same_bits(self):
        large = ["--set", "system.particles=36864", "--set", "shear.strain_rate=0.5", "--set", "run.duration=0.4",
                 "--set", "run.equilibration=0.1"]
        self.sweep("tiny.toml", "--out", "one", "--set", "run.threads=1", *large)
        self.sweep("tiny.toml", "--out", "two", "--set", "run.threads=2", *large)
        self.assertEqual(self.contents("one"), self.contents("two"))

    def test_smooth_particles_give_the_table_of_the_atoms_to_the_bit(self):
        self.sweep("tiny.toml", "--out", "md")
        self.sweep("tiny.toml", "--out", "spam", "--set", 'system.reading="spam"')
        self.assertEqual(self.contents("md"), self.contents("spam"))

    def test_rows_do_not_depend_on_the_rest_of_the_table(self):
        self.sweep("tiny.toml", "--out", "both")
        self.sweep("tiny.toml", "--out", "second", "--set", "shear.strain_rate=1")
        self.assertEqual(self.rows("both")[1:], self.rows("second"))

    def test_the_table_says_what_was_asked_and_found(self):
        process = self.sweep("tiny.toml", "--out", "x")
        self.assertEqual(process.stderr, "")
        rows = self.rows("x")
        self.assertEqual([float(row["strain_rate"]) for row in rows], [0.5, 1.0])
        for row in rows:
            self.assertEqual(row["status"], "ok")
            self.assertGreater(float(row["viscosity_error"]), 0)
            # Energy is kept: K (kT (N - 1)) and Phi add to E = N.
            energy = float(row["potential_energy"]) + float(row["kinetic_temperature"]) * 35 / 36
            self.assertAlmostEqual(energy, 1.0, delta=1e-5)
            # P_kinetic V = K (two dimensions, V = N), and the viscosity is -P_xy over the rate.
            kinetic = (float(row["pxx_kinetic"]) + float(row["pyy_kinetic"])) / 2
            self.assertAlmostEqual(kinetic * 36 / 35, float(row["kinetic_temperature"]), delta=1e-10)
            stress = float(row["pxy_kinetic"]) + float(row["pxy_potential"])
            self.assertAlmostEqual(float(row["viscosity"]), -stress / float(row["strain_rate"]), delta=1e-10)
        with open(self.folder / "x" / "replicas.csv", newline="") as file:
            replicas = list(csv.DictReader(file))
        self.assertEqual([(float(row["strain_rate"]), int(row["replica"])) for row in replicas],
                         [(0.5, 0), (0.5, 1), (1, 0), (1, 1)])
        self.assertEqual({row["steps"] for row in replicas}, {str(round((3 + 60) / 0.05))})
        self.assertIn("rescaling put back", process.stdout)
        self.assertIn("Steps subdivided: 0 of 5040", process.stdout)
        self.assertNotRegex(process.stdout, r"\de[-+]?\d")  # plain decimals
        for name in ("table.csv", "replicas.csv", "point_002.h5"):
            self.assertIn(name, process.stdout)

    def test_rescaling_can_be_switched_off(self):
        process = self.sweep("tiny.toml", "--out", "x", "--set", "run.rescale=false")
        self.assertIn("nothing was rescaled", process.stdout)

    def test_provenance(self):
        self.sweep("tiny.toml", "--out", "x", "--set", "run.seed=5", "--set", "run.threads=1")
        record = json.loads((self.folder / "x" / "provenance.json").read_text())
        self.assertEqual((record["seed"], record["threads"], record["resumed"]), (5, 1, False))
        self.assertEqual(record["command_line"][1:3], ["sweep", "tiny.toml"])
        self.assertEqual(len(record["wall_seconds_of_points"]), 2)
        self.assertTrue(all(seconds > 0 for seconds in record["wall_seconds_of_points"]))
        for key in ("version", "commit", "compiler", "processor", "host", "started", "finished", "generator"):
            self.assertTrue(record[key], key)

    def test_zero_rate_has_pressures_but_no_viscosity(self):
        self.sweep("tiny.toml", "--out", "x", "--set", "shear.strain_rate=0", "--set", "run.target_relative_error=0.1",
                   "--set", "run.duration=400")
        row = self.rows("x")[0]
        self.assertTrue(math.isnan(float(row["viscosity"])))
        self.assertGreater(float(row["pxx_kinetic"]), 0.3)
        self.assertEqual((row["status"], float(row["duration"])), ("ok", 400))

    def test_too_short_for_an_error_bar_is_no_failure(self):
        self.sweep("tiny.toml", "--out", "x", "--set", "run.duration=0.5", "--set", "run.replicas=1")
        self.assertEqual({(row["status"], row["viscosity_error"]) for row in self.rows("x")}, {("short", "nan")})

    def test_a_target_is_reached_or_given_up_at_the_stated_maximum(self):
        self.sweep("tiny.toml", "--out", "x", "--set", "run.target_relative_error=0.03", "--set", "run.duration=20")
        for row in self.rows("x"):
            self.assertEqual(row["status"], "ok")
            self.assertLessEqual(float(row["viscosity_error"]), 0.03 * float(row["viscosity"]))
            self.assertIn(float(row["duration"]), (40, 80, 160, 200))
        process = self.sweep("tiny.toml", "--out", "y", "--set", "run.target_relative_error=1e-5", "--set",
                             "run.maximum_duration=100")
        self.assertEqual({(row["status"], float(row["duration"])) for row in self.rows("y")}, {("short", 100)})
        self.assertIn("short", process.stdout)


class Failures(ProgramTest):
    def setUp(self):
        super().setUp()
        # No step of the second point is exact enough.
        self.write("half.toml", "[system]\nparticles = 36\nenergy_per_particle = 1\n"
                                "[run]\nequilibration = 3\nduration = 60\nreplicas = 2\n"
                                "[[point]]\nstrain_rate = 0.5\n"
                                "[[point]]\nstrain_rate = 1\nenergy_tolerance = 1e-18\n")

    def test_a_point_that_fails_leaves_the_others_alone(self):
        self.sweep("tiny.toml", "--out", "whole")
        process = self.sweep("half.toml", "--out", "half", code=1, says=["1 of 2 points failed"])
        whole, half = self.rows("whole"), self.rows("half")
        self.assertEqual(half[0], whole[0])
        self.assertEqual(half[1]["status"], "failed")
        self.assertTrue(math.isnan(float(half[1]["viscosity"])))
        self.assertIn("failed: N = 36, E/N = 1, rate 1: replica", process.stdout)
        self.assertNotIn("point_002.h5", self.entries("half"))
        again = self.sweep("half.toml", "--out", "half", code=1, says=["1 of 2 points failed"])
        reason = re.search(r"^failed: .*$", process.stdout, re.MULTILINE).group()
        self.assertIn(reason, again.stdout)


class Files(ProgramTest):
    @unittest.skipUnless(h5py, "no h5py here")
    def test_series_and_frames(self):
        process = self.sweep("tiny.toml", "--out", "x", "--set", "output.frame_interval=20",
                             environment=self.environment(pictures=True))
        with h5py.File(self.folder / "x" / "point_001.h5") as file:
            self.assertEqual(sorted(file["observables"]), ["replica_01", "replica_02"])
            self.assertEqual(file["observables/replica_02/pxy_kinetic/value"].shape, (120,))
            self.assertAlmostEqual(file["observables/replica_02/pxy_kinetic/time"][-1], 63.0)
            self.assertEqual(list(file["particles"]), ["replica_01"])
            frames = file["particles/replica_01"]
            self.assertEqual(frames["position/value"].shape, (4, 36, 2))
            self.assertEqual([round(t, 9) for t in frames["position/time"]], [3, 23, 43, 63])
            momenta = frames["momentum/value"][()]
            self.assertLess(abs(momenta.sum(axis=1)).max(), 1e-10)
            self.assertEqual(file["parameters"].attrs["duration"], 60)
        if "viscosity.png" in self.entries("x"):
            for name in ("viscosity.svg", "configuration_001.png", "configuration_002.png"):
                self.assertIn(name, self.entries("x"))
                self.assertIn(name, process.stdout)

    @unittest.skipUnless(h5py, "no h5py here")
    def test_a_point_that_was_extended_states_what_it_recorded(self):
        self.sweep("tiny.toml", "--out", "x", "--set", "run.target_relative_error=1e-5", "--set",
                   "run.maximum_duration=100", "--set", "output.frame_interval=50")
        with h5py.File(self.folder / "x" / "point_001.h5") as file:
            self.assertEqual(file["parameters"].attrs["duration"], 100)
            self.assertEqual(file["observables/replica_01/pxy_kinetic/value"].shape, (200,))
            self.assertAlmostEqual(file["observables/replica_01/pxy_kinetic/time"][-1], 103.0)
            self.assertEqual([round(t, 9) for t in file["particles/replica_01/position/time"]], [3, 53, 103])

    def test_without_python_the_commands_are_printed(self):
        process = self.sweep("tiny.toml", "--out", "x", "--set", "output.frame_interval=20")
        self.assertIn("plot_viscosity.py x", process.stdout)
        self.assertIn("plot_configuration.py x/point_002.h5 x/configuration_002.png", process.stdout)
        self.assertNotIn("viscosity.png", self.entries("x"))

    def test_a_plot_that_fails_does_not_fail_the_sweep(self):
        self.sweep("tiny.toml", "--out", "x")
        (self.folder / "x" / "viscosity.svg" / "full").mkdir(parents=True)  # where the picture is to be renamed to
        process = self.sweep("tiny.toml", "--out", "x", environment=self.environment(pictures=True))
        self.assertRegex(process.stdout, "No viscosity.png: plot_viscosity.py: cannot write|No pictures: there is no Python")


class Terminal(ProgramTest):
    def test_a_status_line_is_drawn_and_removed(self):
        ours, theirs = pty.openpty()
        process = subprocess.Popen(
            [PROGRAM, "sweep", "tiny.toml", "--out", "x", "--set", "run.duration=4000", "--set", "run.threads=1"],
            cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=theirs,
            env=self.environment(TERM="xterm"))
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # the other side is closed
                break
            if not part:
                break
            text += part
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        lines = text.decode().split("\r\x1b[K")
        self.assertGreater(len(lines), 2)
        self.assertEqual(lines[-1], "")
        self.assertTrue(any(re.match(r"^(\[#*-*\]  )?\s*\d+ %  \d/2 points ", line) for line in lines), lines)
        self.assertTrue(all(len(line) < 80 for line in lines), lines)


if __name__ == "__main__":
    unittest.main()

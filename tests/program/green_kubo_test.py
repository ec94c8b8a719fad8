# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy green-kubo`: tables that do not depend on threads or interruptions, refusals, series from elsewhere, pictures."""

import json
import math
import random
import time
import unittest

from running import CommandPromises, CommandTest

SMALL = """\
title = "two small states"
[system]
particles = 100
energy_per_particle = [0.5, 0.6]
[run]
preparation = 10
equilibration = 10
duration = 800
replicas = 3
seed = 4
[correlation]
length = 100
"""


class GreenKuboTest(CommandTest):
    COMMAND = "green-kubo"
    KIND = "Green-Kubo run"
    SMALL = SMALL
    RESULTS = ("viscosity.csv", "correlation.csv", "notes.txt", "input.toml", "point_001.h5", "point_002.h5")


class Results(GreenKuboTest):
    def test_the_tables_say_what_was_asked_and_found(self):
        process = self.run_input("small.toml", "--out", "x")
        self.assertEqual(process.stderr, "")
        rows = self.table("x")
        self.assertEqual(list(rows[0])[:4], ["energy_per_particle", "particles", "viscosity", "viscosity_error"])
        self.assertEqual([float(row["energy_per_particle"]) for row in rows], [0.5, 0.6])
        curves = self.table("x", "correlation.csv")
        for row in rows:
            number = {name: float(value) for name, value in row.items() if name != "status"}
            self.assertGreater(number["viscosity_error"], 0)
            energy = number["potential_energy"] + number["kinetic_temperature"] * 99 / 100
            self.assertAlmostEqual(energy, number["energy_per_particle"], delta=1e-4)
            self.assertAlmostEqual(number["pressure"], number["pressure_kinetic"] + number["pressure_potential"],
                                   delta=1e-12)
            parts = number["viscosity_kinetic"] + number["viscosity_cross"] + number["viscosity_potential"]
            self.assertAlmostEqual(parts, number["viscosity"], delta=1e-9)
            mean = (number["viscosity_xy"] + number["viscosity_difference"]) / 2
            self.assertAlmostEqual(mean, number["viscosity"], delta=1e-9)
            # The value of the table is the running integral of the curve at the cut-off.
            curve = [{name: float(value) for name, value in point.items()} for point in curves
                     if point["energy_per_particle"] == row["energy_per_particle"]]
            before = [point for point in curve if point["time"] <= number["cutoff"]][-1]
            after = [point for point in curve if point["time"] >= number["cutoff"]][0]
            between = sorted((before["integral"], after["integral"]))
            self.assertGreaterEqual(number["viscosity"], between[0] - 1e-9)
            self.assertLessEqual(number["viscosity"], between[1] + 1e-9)
            self.assertAlmostEqual(curve[0]["C_mean"], number["shear_modulus"], delta=1e-9)
            self.assertAlmostEqual(curve[0]["C_mean"], (curve[0]["C_xy"] + curve[0]["C_difference"]) / 2, delta=1e-12)
            self.assertEqual(curve[0]["integral"], 0)
            self.assertAlmostEqual(curve[-1]["time"], 100, delta=1e-9)
        self.assertNotRegex(process.stdout, r"\de[-+]?\d")  # plain decimals
        for name in ("viscosity.csv", "correlation.csv", "point_002.h5", "provenance.json"):
            self.assertIn(name, process.stdout)
        record = json.loads((self.folder / "x" / "provenance.json").read_text())
        self.assertEqual(record["seed"], 4)

    def test_other_correlations_come_with_it(self):
        self.run_input("small.toml", "--out", "x", "--set", "correlation.diffusion=true", "--set",
                       "correlation.thermal_conductivity=true", "--set", 'correlation.pairs=["pressure pressure"]')
        row = self.table("x")[1]
        self.assertGreater(float(row["self_diffusion"]), 0)
        self.assertGreater(float(row["thermal_conductivity"]), 0)
        pairs = self.table("x", "pairs.csv")
        self.assertEqual(len({line["pair"] for line in pairs}), 3)
        self.assertIn("pressure pressure", {line["pair"] for line in pairs})

    def test_a_short_run_is_flagged_not_refused(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.duration=6", "--set", "run.replicas=1",
                                 "--set", "correlation.length=2")
        rows = self.table("x")
        self.assertEqual({row["status"] for row in rows}, {"short"})
        self.assertTrue(math.isnan(float(rows[0]["viscosity_error"])))
        self.assertIn("short", process.stdout)
        process = self.run_input("small.toml", "--out", "y", "--set", "run.duration=200")
        self.assertEqual({row["status"] for row in self.table("y")}, {"short"})
        self.assertIn("cut-off", process.stdout)

    def test_multiple_tau_finds_the_same_viscosity(self):
        self.run_input("small.toml", "--out", "x")
        self.run_input("small.toml", "--out", "y", "--set", 'correlation.method="multiple-tau"')
        for one, other in zip(self.table("x"), self.table("y")):
            self.assertAlmostEqual(float(one["viscosity"]), float(other["viscosity"]),
                                   delta=0.5 * float(one["viscosity_error"]) + 0.02 * float(one["viscosity"]))
            self.assertEqual(one["kinetic_temperature"], other["kinetic_temperature"])

    def test_pictures(self):
        process = self.run_input("small.toml", "--out", "x", environment=self.environment(pictures=True))
        self.assertIn("correlation.png", process.stdout)
        self.assertTrue((self.folder / "x" / "correlation.png").read_bytes().startswith(b"\x89PNG"))
        self.assertTrue((self.folder / "x" / "correlation.svg").exists())
        self.run_input("small.toml", "--out", "y", "--no-pictures", environment=self.environment(pictures=True))
        self.assertNotIn("correlation.png", self.entries("y"))

    def test_a_state_that_fails_does_not_stop_the_others(self):
        narrow = ["--set", "run.step=0.2", "--set", "run.energy_band=0.0002"]
        process = self.lucy("green-kubo", "small.toml", "--out", "x", *narrow)
        self.expect(process, 1, "1 of 2 points failed")
        self.assertEqual([row["status"] for row in self.table("x")], ["ok", "failed"])
        self.assertIn("run.energy_band", process.stdout)
        again = self.lucy("green-kubo", "small.toml", "--out", "x", *narrow)
        self.expect(again, 1, "1 of 2 points failed")
        self.assertIn("run.energy_band", again.stdout)


class Refusals(GreenKuboTest):
    def test_unsound_states(self):
        self.expect_refusals(
            ("output.sample_interval=5", "must be at most"),
            ("system.energy_per_particle=0.41", "must be above 0.413"),
            ("run.step=0.3", "run.step"),
            ("correlation.length=900", "run.duration = 800"),
            ('correlation.pairs=["pressure"]', "is not a pair"),
            ("system.particles=25", "below twice kernel.range"),
            ("shear.strain_rate=1", "unknown section [shear]"),
            ("run.duration=nan", "run.duration"),
            ("correlation.method='slow'", "multiple-tau"))

    def test_a_directory_of_a_sweep_is_left_alone(self):
        self.sweep("tiny.toml", "--out", "x")
        before = self.contents("x", ("input.toml", "table.csv"))
        self.run_input("small.toml", "--out", "x", code=2, says=("x", "another input"))
        self.assertEqual(self.contents("x", ("input.toml", "table.csv")), before)

    def test_no_input_at_all(self):
        self.run_input(code=2, says=("needs INPUT",))
        self.run_input("small.toml", "--interval", "0.2", code=2, says=("--interval needs --from-series",))

    def test_check_and_explain_know_it(self):
        process = self.lucy("check", "small.toml")
        self.expect(process, 0)
        self.assertIn("blocks", process.stdout)
        self.assertIn("wall time", process.stdout)
        self.write("spaced.toml", SMALL.replace("[correlation]", "[ correlation ]"))
        self.assertIn("blocks", self.lucy("check", "spaced.toml").stdout)
        self.expect(self.lucy("check", "tiny.toml", "--for", "green-kubo"), 2, "shear")
        process = self.lucy("explain", "--for", "green-kubo", "correlation")
        self.expect(process, 0)
        self.assertIn("[correlation]", process.stdout)
        self.assertIn("twice the cut-off", process.stdout)
        self.assertFalse((self.folder / "runs").exists())

    def test_check_lasts_no_longer_for_long_intervals(self):
        begin = time.monotonic()
        process = self.lucy("check", "small.toml", "--set", "system.particles=40000", "--set", "run.step=0.0001")
        self.expect(process, 0)
        self.assertLess(time.monotonic() - begin, 30)
        self.assertNotIn("unknown", process.stdout)


class Promises(CommandPromises, GreenKuboTest):
    LONGER = SMALL.replace("duration = 800", "duration = 3000").replace(
        "seed = 4", "seed = 4\nthreads = 2\ncheckpoint_interval = 0.05")
    EXTRA = ("--set", "correlation.diffusion=true", "--set", "output.series=true", "--set", "output.frame_interval=200")
    PRINTED_AGAIN = ("--set", "run.duration=200")
    LONGEST_WAIT = 0.08


class Series(GreenKuboTest):
    """An autoregressive series: <x x_k> = phi^|k|, so that eta = dt (1/2 + phi/(1 - phi)) by the trapezoidal rule."""

    def setUp(self):
        super().setUp()
        generator = random.Random(11)
        self.rows = 80000
        phi = math.exp(-0.2 / 4.0)
        noise = math.sqrt(1.0 - phi * phi)
        x, d = generator.gauss(0, 1), generator.gauss(0, 1)
        lines = ["# TimeStep v_pxy v_pxx v_pyy"]
        for row in range(self.rows):
            lines.append(f"{10 * row} {x:.8g} {3 + d:.8g} {3 - d:.8g}")
            x = phi * x + noise * generator.gauss(0, 1)
            d = phi * d + noise * generator.gauss(0, 1)
        self.write("stress.dat", "\n".join(lines) + "\n")
        self.truth = 0.2 * (0.5 + phi / (1.0 - phi))
        self.options = ["--from-series", "stress.dat", "--interval", "0.2", "--volume", "1", "--temperature", "1"]

    def test_gives_the_known_integral(self):
        self.run_input(*self.options, "--pxy", "v_pxy", "--pxx", "v_pxx", "--pyy", "4", "--out", "x")
        self.assertIn("--from-series", json.loads((self.folder / "x" / "provenance.json").read_text())["command_line"])
        self.expect(self.lucy("viscosity", "x", "x"), 2)
        row, = self.table("x")
        for name in ("viscosity", "viscosity_spectrum"):
            self.assertAlmostEqual(float(row[name]), self.truth, delta=4 * float(row[f"{name}_error"]))
            self.assertLess(float(row[f"{name}_error"]), 0.2 * self.truth)
        self.assertAlmostEqual(float(row["decay_time"]), 4.0, delta=4 * float(row["decay_time_error"]))
        self.assertTrue(math.isnan(float(row["viscosity_kinetic"])))
        self.run_input(*self.options, "--pxy", "2", "--pxx", "3", "--pyy", "4", "--out", "x")  # the same once more
        other, = self.table("x")
        self.assertEqual(row, other)
        self.run_input(*self.options, "--pxy", "2", "--pxx", "3", "--pyy", "4", "--length", "30", "--out", "x", code=2,
                       says=("x",))

    def test_times_of_the_file_are_compared_with_the_interval(self):
        rows = [f"{0.2 * i:.1f} {math.sin(0.7 * i)} {math.cos(i)} {math.sin(i * i)}" for i in range(2000)]
        names = "# time pxy pxx pyy"
        options = self.options[2:]
        self.write("even.dat", "\n".join([names, *rows]))
        self.run_input("--from-series", "even.dat", *options, "--out", "even")
        for name, lines, says in (("hole", rows[:700] + rows[701:], "row 701"),
                                  ("twice", rows[:5] + rows[4:], "row 6"),
                                  ("slower", [row for row in rows[::2]], "row 2")):
            self.write(f"{name}.dat", "\n".join([names, *lines]))
            self.run_input("--from-series", f"{name}.dat", *options, "--out", "x", code=2,
                           says=(f"{name}.dat: {says} has the time", "--interval = 0.2"))
        self.assertFalse((self.folder / "x").exists())

    def test_refusals(self):
        for extra, says in ((["--pxy", "pyx"], "pyx"), (["--pxy", "9"], "9"),
                            (["--pxy", "2", "--pxx", "3", "--difference", "3"], "--difference"),
                            (["--set", "run.seed=1"], "--set"), (["small.toml"], "takes no INPUT")):
            with self.subTest(extra):
                self.run_input(*self.options, *extra, "--out", "x", code=2, says=(says,))
        self.run_input("--from-series", "stress.dat", "--volume", "1", "--temperature", "1", code=2,
                       says=("needs --interval",))
        self.run_input("--from-series", "stress.dat", "--interval", "0.2", "--volume", "-1", "--temperature", "1",
                       "--pxy", "2", "--pxx", "3", "--pyy", "4", code=2, says=("--volume = -1 must be above 0",))
        self.run_input("--from-series", "nothing.dat", "--interval", "0.2", "--volume", "1", "--temperature", "1",
                       code=2, says=("nothing.dat",))
        self.write("bad.dat", "1 2 3\n1 2\n")
        self.run_input("--from-series", "bad.dat", "--interval", "0.2", "--volume", "1", "--temperature", "1",
                       "--pxy", "1", "--pxx", "2", "--pyy", "3", code=2, says=("bad.dat:2",))
        self.assertFalse((self.folder / "x").exists())


if __name__ == "__main__":
    unittest.main()

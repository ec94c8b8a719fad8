# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy shear-wave` and `lucy temperature-wave`: tables that do not depend on threads or interruptions, refusals,
failures, frames, pictures."""

import json
import math
import unittest

from running import CommandPromises, CommandTest

SMALL = """\
title = "small waves"
[system]
particles = 144
[fluid]
viscosity = 0.5
[start]
disorder = 0.2
[wave]
amplitude = 0.05
[run]
step = 0.5
duration = 30
replicas = 4
seed = 4
[[point]]
[[point]]
viscosity = 0.2
range = 2.5
[[point]]
reading = "md"
energy_per_particle = 1
viscosity = 0
disorder = 0
amplitude = 0.5
step = 0.1
equilibration = 5
duration = 10
"""

HEAT = """\
[system]
particles = 144
[fluid]
viscosity = 0.5
conductivity = 1
[start]
disorder = 0.2
[run]
step = 0.5
duration = 20
replicas = 4
"""

COMPANIONS = ("local.csv", "forms.csv", "amplitude.csv", "notes.txt", "input.toml")


class WaveTest(CommandTest):
    COMMAND = "shear-wave"
    KIND = "shear-wave run"
    SMALL = SMALL
    RESULTS = ("shear_wave.csv", *COMPANIONS)

    def setUp(self):
        super().setUp()
        self.write("heat.toml", HEAT)

    def temperature_wave(self, *arguments, **options):
        return self.run_input(*arguments, command="temperature-wave", **options)


class Results(WaveTest):
    def test_the_tables_say_what_was_asked_and_found(self):
        process = self.run_input("small.toml", "--out", "x")
        self.assertEqual(process.stderr, "")
        rows = self.table("x")
        self.assertEqual([row["viscosity"] for row in rows], ["0.5", "0.2", "nan"])
        self.assertEqual([row["reading"] for row in rows], ["spam", "spam", "md"])
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        for row in rows:
            number = {name: float(row[name]) for name in ("operator", "pressure_forces", "carried", "total", "integral",
                                                          "total_error", "integral_error", "wave_vector", "prescribed")}
            self.assertAlmostEqual(number["wave_vector"], 2 * math.pi / 12, places=12)
            self.assertAlmostEqual(number["operator"] + number["pressure_forces"] + number["carried"], number["total"],
                                   places=12)
            self.assertGreater(number["total_error"], 0)
            self.assertGreater(number["total"], 0)
            if not math.isnan(number["integral"]):  # of a wave that does not ring
                spread = math.hypot(number["total_error"], number["integral_error"])
                self.assertLess(abs(number["total"] - number["integral"]), 4 * spread + 0.1 * number["total"])
        self.assertFalse(math.isnan(float(rows[0]["integral"])))
        self.assertGreater(float(rows[0]["operator"]), 0.3)
        self.assertEqual(float(rows[2]["operator"]), 0)
        curves = self.table("x", "amplitude.csv")
        for point, row in enumerate(rows, 1):
            curve = [line for line in curves if line["point"] == str(point)]
            self.assertAlmostEqual(float(curve[-1]["time"]), float(row["duration"]), delta=1e-9)
            self.assertAlmostEqual(float(curve[0]["amplitude"]), float(row["imposed_amplitude"]),
                                   delta=1e-12 if row["noise"] == "0" else 1.0)
        forms = self.table("x", "forms.csv")
        self.assertEqual(len(forms), 9)
        for point, row in enumerate(rows, 1):
            preferred, = [form for form in forms if form["point"] == str(point) and form["preferred"] == "yes"]
            self.assertEqual(preferred["form"], row["preferred_form"])
            self.assertEqual(preferred["diffusivity"], row["fitted"])
        self.assertTrue(self.table("x", "local.csv"))
        self.assertNotRegex(process.stdout, r"\de[-+]?\d")  # plain decimals
        for name in ("shear_wave.csv", *COMPANIONS, "provenance.json"):
            self.assertIn(name, process.stdout)
        self.assertEqual(json.loads((self.folder / "x" / "provenance.json").read_text())["seed"], 4)

    def test_temperature_waves_too(self):
        process = self.temperature_wave("heat.toml", "--out", "x")
        row, = self.table("x", "temperature_wave.csv")
        self.assertEqual(float(row["prescribed"]), 0.5)
        self.assertAlmostEqual(float(row["total"]), 0.5, delta=0.15)
        self.assertEqual(row["yield_stress"], "nan")
        self.assertIn("heating", process.stdout)
        self.assertIn("temperature_wave.csv", process.stdout)

    def test_a_short_run_is_flagged_not_refused(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.replicas=1")
        self.assertEqual({row["status"] for row in self.table("x")}, {"short"})
        self.assertIn("short: ", process.stdout)
        process = self.run_input("small.toml", "--out", "y", "--set", "fluid.viscosity=0", "--set", "run.duration=8")
        self.assertEqual(self.table("y")[0]["status"], "short")
        self.assertIn("warning: point 1: The amplitude fell to", process.stdout)
        self.assertIn("Point 1 warning", (self.folder / "y" / "notes.txt").read_text())

    def test_a_point_that_fails_does_not_stop_the_others(self):
        self.write("hot.toml", HEAT + "energy_tolerance = 1e-5\n[[point]]\n[[point]]\nenergy_tolerance = 1e-30\n")
        process = self.temperature_wave("hot.toml", "--out", "x", code=1, says=("1 of 2 points failed",))
        self.assertEqual([row["status"] for row in self.table("x", "temperature_wave.csv")], ["ok", "failed"])
        self.assertIn("failed: point 2: replica", process.stdout)
        again = self.temperature_wave("hot.toml", "--out", "x", code=1, says=("1 of 2 points failed",))
        self.assertIn("failed: point 2: replica", again.stdout)

    def test_frames_hold_internal_energies(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("no h5py")
        self.run_input("small.toml", "--out", "x", "--set", "output.frame_interval=2", "--set", "run.duration=8")
        with h5py.File(self.folder / "x" / "point_001.h5") as file:
            particles = file["particles/replica_01"]
            self.assertEqual(particles["position/value"].shape, (5, 144, 2))
            self.assertEqual(particles["internal_energy/value"].shape, (5, 144))
            self.assertEqual(list(particles["position/time"]), [0, 2, 4, 6, 8])
            self.assertEqual(file["parameters"].attrs["viscosity"], 0.5)
            amplitude = file["observables/replica_01/amplitude/value"][:]
            y = particles["position/value"][2, :, 1]
            v = particles["momentum/value"][2, :, 0]
            k = file["parameters"].attrs["wave_vector"]
            time_of = list(file["observables/replica_01/amplitude/time"])
            expected = amplitude[time_of.index(4.0)]
            sine = [math.sin(k * value) for value in y]
            self.assertAlmostEqual(2 / 144 * sum(a * b for a, b in zip(v, sine)), expected, places=12)
        with h5py.File(self.folder / "x" / "point_003.h5") as file:
            self.assertNotIn("internal_energy", file["particles/replica_01"])
            self.assertEqual(file["particles/replica_01/position/time"][0], 5)

    def test_pictures(self):
        process = self.run_input("small.toml", "--out", "x", environment=self.environment(pictures=True))
        for name in ("shear_wave.png", "shear_wave.svg", "amplitudes.png", "amplitudes.svg"):
            self.assertIn(name, process.stdout)
            self.assertTrue((self.folder / "x" / name).exists())


class Refusals(WaveTest):
    def test_unsound_points(self):
        self.expect_refusals(
            ("run.step=0.6", "at most 0.5"),
            ("wave.mode=3", "must be at least twice kernel.range"),
            ("wave.amplitude=0", "wave.amplitude"),
            ("system.particles=25", "kernel.range"),
            ("fluid.viscosity=-1", "fluid.viscosity"),
            ("run.duration=nan", "run.duration"),
            ("shear.strain_rate=1", "unknown section [shear]"),
            ("kernel.name='gauss'", "monaghan"),
            ("output.sample_interval=0.3", "whole number of steps"))

    def test_atoms_and_heat_and_fluids_without_entropy(self):
        self.temperature_wave("small.toml", "--out", "x", code=2,
                              says=("small.toml:21:", "energy_per_particle"))
        self.temperature_wave("heat.toml", "--set", "fluid.equation_of_state='dense-fluid'", code=2,
                              says=("entropy",))
        self.run_input("heat.toml", "--set", "system.reading='md'", code=2,
                       says=("system.energy_per_particle is required",))
        self.run_input("heat.toml", "--set", "system.reading='md'", "--set", "system.energy_per_particle=1", code=2,
                       says=("heat.toml:4: fluid.viscosity = 0.5 is for smooth particles",))

    def test_a_directory_of_the_other_command_is_left_alone(self):
        self.temperature_wave("heat.toml", "--out", "x")
        results = ("temperature_wave.csv", *COMPANIONS)
        before = self.contents("x", results)
        self.run_input("heat.toml", "--out", "x", code=2, says=("x", "another input"))
        self.assertEqual(self.contents("x", results), before)

    def test_check_and_explain_know_them(self):
        process = self.lucy("check", "small.toml")
        self.expect(process, 0)
        self.assertIn("shear-waves", process.stdout)
        self.assertIn("atoms E/N 1", process.stdout)
        self.assertIn("wall time", process.stdout)
        self.expect(self.lucy("check", "heat.toml"), 2, "heat.toml", "--for shear-wave or --for temperature-wave")
        process = self.lucy("check", "heat.toml", "--for", "temperature-wave")
        self.expect(process, 0)
        self.assertIn("temperature-waves", process.stdout)
        self.assertIn("kappa = 1", process.stdout)
        self.assertIn("Wavelengths",
                      self.lucy("explain", "--for", "shear-wave", "wave.mode").stdout)
        self.assertIn("temperatures are multiplied",
                      self.lucy("explain", "--for", "temperature-wave", "wave").stdout)
        self.assertFalse((self.folder / "runs").exists())


class Promises(CommandPromises, WaveTest):
    LONGER = SMALL.replace("particles = 144", "particles = 1024").replace(
        "[[point]]\nviscosity", "[[point]]\nequilibration = 20\nviscosity").replace(
            "seed = 4", "seed = 4\nthreads = 2\ncheckpoint_interval = 0.05")
    PRINTED_AGAIN = ("--set", "run.duration=6")


if __name__ == "__main__":
    unittest.main()

# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy shear-flow`: tables that do not depend on threads or interruptions, refusals, flows that are not steady."""

import json
import math
import re
import unittest

from running import CommandPromises, CommandTest

SMALL = """\
title = "two small flows"
[system]
particles = 64
[fluid]
viscosity = 0.5
conductivity = 0.5
[shear]
strain_rate = [0.1, 0.3]
[run]
equilibration = 10
duration = 100
replicas = 2
seed = 4
"""


class ShearFlowTest(CommandTest):
    COMMAND = "shear-flow"
    KIND = "shear-flow run"
    SMALL = SMALL
    RESULTS = ("shear_flow.csv", "notes.txt", "input.toml", "point_001.h5", "point_002.h5")


class Results(ShearFlowTest):
    def test_the_table_says_what_was_asked_and_found(self):
        process = self.run_input("small.toml", "--out", "x")
        self.assertEqual(process.stderr, "")
        rows = self.table("x")
        self.assertEqual([float(row["strain_rate"]) for row in rows], [0.1, 0.3])
        for row in rows:
            self.assertEqual((row["equation_of_state"], row["kernel"], row["cooling"], row["status"]),
                             ("ideal-gas", "lucy", "isoenergetic", "ok"))
            number = {name: float(value) for name, value in row.items()
                      if name not in ("equation_of_state", "kernel", "cooling", "status")}
            rate = number["strain_rate"]
            parts = sum(number[f"viscosity_{part}"] for part in ("carried", "pressure", "newtonian"))
            self.assertAlmostEqual(number["viscosity"], parts, delta=1e-12)
            self.assertAlmostEqual(number["viscosity_excess"], number["viscosity"] - 0.5, delta=1e-12)
            self.assertAlmostEqual(number["viscosity_newtonian"], -number["pxy_newtonian"] / rate, delta=1e-12)
            self.assertAlmostEqual(number["work"], number["viscosity"] * rate**2, delta=1e-12)
            self.assertAlmostEqual(number["work"], number["heat_removed"], delta=1e-12)
            self.assertAlmostEqual(number["temperature"], number["internal_energy"], delta=0.01)
            self.assertGreater(number["entropy_viscosity"], 0)
            self.assertAlmostEqual(number["viscosity_newtonian"], 0.5, delta=0.05)
            self.assertGreater(number["viscosity_error"], 0)
        self.assertIsNone(re.search(r"\de[-+]?\d", process.stdout.split("Reduced units")[0]))  # plain decimals
        for name in ("shear_flow.csv", "point_002.h5", "provenance.json"):
            self.assertIn(name, process.stdout)
        record = json.loads((self.folder / "x" / "provenance.json").read_text())
        self.assertEqual(record["seed"], 4)

    def test_every_fluid_flows(self):
        self.write("fluids.toml", SMALL.replace("[0.1, 0.3]", "0.1").replace("= 100", "= 20") + """
[[point]]
equation_of_state = "van-der-waals"
[[point]]
equation_of_state = "dense-fluid"
kernel.name = "monaghan"
[[point]]
equation_of_state = "isentropic"
conductivity = 0
""")
        process = self.run_input("fluids.toml", "--out", "x")
        rows = self.table("x")
        self.assertEqual([row["equation_of_state"] for row in rows], ["van-der-waals", "dense-fluid", "isentropic"])
        self.assertAlmostEqual(float(rows[0]["internal_energy"]), 0.5, delta=0.02)  # kT - a rho
        self.assertAlmostEqual(float(rows[1]["pressure"]), 5.0, delta=0.1)
        self.assertEqual((rows[2]["temperature"], rows[2]["entropy_viscosity"]), ("nan", "nan"))
        self.assertIn("dense-fluid, monaghan", process.stdout)

    def test_a_short_run_is_flagged_not_refused(self):
        self.run_input("small.toml", "--out", "x", "--set", "run.duration=0.3", "--set", "run.replicas=1")
        self.assertEqual({row["status"] for row in self.table("x")}, {"short"})
        self.assertTrue(math.isnan(float(self.table("x")[0]["viscosity_error"])))

    def test_without_cooling_the_fluid_heats_up_and_nothing_has_an_error(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "shear.cooling='none'")
        rows = self.table("x")
        self.assertEqual({row["status"] for row in rows}, {"short"})
        for row in rows:
            self.assertEqual(float(row["heat_removed"]), 0)
            self.assertGreater(float(row["temperature"]), 1.1)
            self.assertEqual(row["viscosity_error"], "nan")
        self.assertIn("not steady", process.stdout)

    def test_a_fluid_that_is_cooled_away_fails_and_does_not_stop_the_others(self):
        self.write("thin.toml", SMALL.replace("[0.1, 0.3]", "0.5").replace("replicas = 2", "replicas = 1") + """
[[point]]
strain_rate = 0.1
[[point]]
viscosity = 0
conductivity = 0
noise = 0.5
""")
        process = self.run_input("thin.toml", "--out", "x", code=1, says=("1 of 2 points failed",))
        self.assertEqual([row["status"] == "failed" for row in self.table("x")], [False, True])
        self.assertIn("the temperature of particle", process.stdout)
        again = self.run_input("thin.toml", "--out", "x", code=1, says=("1 of 2 points failed",))
        self.assertIn("the temperature of particle", again.stdout)

    def test_frames_hold_internal_energies(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("no h5py")
        self.run_input("small.toml", "--out", "x", "--set", "output.frame_interval=25")
        with h5py.File(self.folder / "x" / "point_002.h5") as file:
            self.assertEqual(file["particles/replica_01/internal_energy/value"].shape, (5, 64))
            self.assertEqual(file["particles/replica_01/position/time"][0], 10)
            series = file["observables/replica_02"]
            self.assertEqual(series["pxy_carried/value"].shape, (100,))
            self.assertEqual(series["instants/entropy_viscosity/value"].shape, (100,))
            self.assertEqual(file["parameters"].attrs["viscosity"], 0.5)

    def test_pictures(self):
        environment = self.environment(pictures=True)
        process = self.run_input("small.toml", "--out", "x", environment=environment)
        if "No pictures" in process.stdout:
            self.skipTest("no matplotlib")
        self.assertIn("shear_flow.png", process.stdout)
        self.assertTrue((self.folder / "x" / "shear_flow.png").read_bytes().startswith(b"\x89PNG"))


class Refusals(ShearFlowTest):
    def test_unsound_flows(self):
        self.expect_refusals(
            ("shear.strain_rate=0", "must be finite and not 0"),
            ("system.particles=25", "at least twice kernel.range"),
            ("run.step=0.3", "run.step"),
            ("run.duration=nan", "run.duration"),
            ("fluid.viscosity=-1", "fluid.viscosity"),
            ("fluid.equation_of_state='air'", "van-der-waals"),
            ("shear.cooling='slow'", "isoenergetic"),
            ("shear.thermostat='none'", "unknown key"),
            ("output.sample_interval=200", "must be at most"))

    def test_what_does_not_go_together_is_told_at_its_line(self):
        self.run_input("small.toml", "--set", "fluid.equation_of_state='isentropic'", code=2,
                       says=("small.toml:6: fluid.conductivity = 0.5 needs",))

    def test_the_input_of_a_sweep_is_told_as_such(self):
        self.run_input("tiny.toml", code=2, says=("energy_per_particle", "belongs to an input of `lucy sweep`"))

    def test_check_and_explain_know_it(self):
        process = self.lucy("check", "small.toml")
        self.expect(process, 0)
        self.assertIn("ideal-gas, viscosity 0.5, rate 0.3", process.stdout)
        self.assertIn("wall time", process.stdout)
        process = self.lucy("explain", "--for", "shear-flow", "cooling")
        self.expect(process, 0)
        self.assertIn("gives up the same share of", process.stdout)
        self.assertFalse((self.folder / "runs").exists())


class Promises(CommandPromises, ShearFlowTest):
    LONGER = SMALL.replace("duration = 100", "duration = 400").replace(
        "seed = 4", "seed = 4\nthreads = 2\ncheckpoint_interval = 0.05") + "[output]\nframe_interval = 100\n"


if __name__ == "__main__":
    unittest.main()

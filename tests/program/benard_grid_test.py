# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy benard-grid`: meshes and their limit, growth rates, flows that fail, refusals, interruptions."""

import json
import re
import unittest

from running import CommandPromises, CommandTest

SMALL = """\
title = "small meshes"
[cell]
height = 10
[fluid]
rayleigh = [2000, 5000]
[grid]
cells = [6, 8, 10]
"""


class BenardGridTest(CommandTest):
    COMMAND = "benard-grid"
    KIND = "benard-grid run"
    SMALL = SMALL
    RESULTS = ("benard_grid.csv", "extrapolated.csv", "notes.txt", "input.toml", "point_001.h5", "point_006.h5")


class Results(BenardGridTest):
    def test_every_mesh_and_their_limit(self):
        process = self.run_input("small.toml", "--out", "x")
        self.assertEqual(process.stderr, "")
        rows = self.table("x")
        self.assertEqual([(float(row["rayleigh"]), int(row["cells"])) for row in rows],
                         [(ra, n) for ra in (2000, 5000) for n in (6, 8, 10)])
        for row in rows:
            self.assertEqual((row["status"], row["find"], row["side"]), ("ok", "steady-state", "periodic"))
            self.assertLess(abs(float(row["mass_error"])), 1e-13)
            self.assertGreater(float(row["nusselt_hot"]), 1.05)
        limits = self.table("x", "extrapolated.csv")
        self.assertEqual([int(row["meshes"]) for row in limits], [3, 3])
        self.assertAlmostEqual(float(limits[1]["kinetic_energy"]), 0.003398, delta=5e-5)
        self.assertGreater(float(limits[1]["kinetic_energy_error"]), 0)
        self.assertNotIn("critical.csv", self.entries("x"))
        self.assertIsNone(re.search(r"\de[-+]?\d", process.stdout.split("Reduced units")[0]))  # plain decimals
        for name in ("benard_grid.csv", "extrapolated.csv", "point_006.h5", "provenance.json"):
            self.assertIn(name, process.stdout)
        record = json.loads((self.folder / "x" / "provenance.json").read_text())
        self.assertIn("nothing is random", json.dumps(record))

    def test_growth_rates_and_the_critical_rayleigh_number(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.find='growth-rate'", "--set",
                                 "fluid.rayleigh=[1600,1900]")
        found = self.table("x", "critical.csv")
        self.assertEqual([row["cells"] for row in found], ["6", "8", "10", "extrapolated"])
        self.assertAlmostEqual(float(found[-1]["critical_rayleigh"]), 1712, delta=10)
        self.assertIn("Critical Rayleigh number", process.stdout)

    def test_four_walls_and_other_fluids(self):
        self.run_input("small.toml", "--out", "x", "--set", "cell.side='walls'", "--set", "fluid.rayleigh=10000",
                       "--set", "grid.cells=[10,12,14]", "--set", "fluid.equation_of_state='van-der-waals'", "--set",
                       "fluid.transport='kinematic'")
        for row in self.table("x"):
            self.assertEqual((row["status"], float(row["width"])), ("ok", 10))
            self.assertGreater(float(row["nusselt_sides"]), 0.001)

    def test_the_history_and_the_last_fields_are_kept(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("no h5py")
        self.run_input("small.toml", "--out", "x")
        rows = self.table("x")
        with h5py.File(self.folder / "x" / "point_002.h5") as file:
            self.assertEqual(file["history/kinetic_energy"][-1], float(rows[1]["kinetic_energy"]))
            self.assertEqual(file["history/time"][0], 0)
            self.assertEqual(file["fields/temperature"].shape, (9, 17))
            self.assertEqual(file["fields/temperature"][0, 3], 1.5)
            self.assertEqual(file["fields/velocity_y"][0, 3], 0)
            self.assertEqual(file["parameters"].attrs["cells"], 8)

    def test_a_flow_that_breaks_down_fails_with_all_before_it_on_disk(self):
        self.write("wild.toml", SMALL + "[[point]]\nrayleigh = 5000\ncells = 8\n"
                   "[[point]]\nrayleigh = 5000\ncells = 8\nroll_velocity = 30\n")
        self.write("wild.toml", (self.folder / "wild.toml").read_text().replace("[2000, 5000]", "5000").replace(
            "[6, 8, 10]", "8"))
        for _ in range(2):  # run, and printed again
            process = self.run_input("wild.toml", "--out", "x", code=1, says=("1 of 2 points failed",))
            self.assertIn("at time", process.stdout)
            self.assertIn("must be above 0", process.stdout)
        self.assertEqual([row["status"] for row in self.table("x")], ["ok", "failed"])
        self.assertIn("point_002.h5", self.entries("x"))

    def test_a_flow_that_is_not_steady_is_short(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.duration=20")
        self.assertEqual({row["status"] for row in self.table("x")}, {"short"})
        self.assertIn("short: not steady", process.stdout)

    def test_pictures(self):
        environment = self.environment(pictures=True)
        process = self.run_input("small.toml", "--out", "x", environment=environment)
        if "No pictures" in process.stdout:
            self.skipTest("no matplotlib")
        self.assertTrue((self.folder / "x" / "benard_grid.png").read_bytes().startswith(b"\x89PNG"))
        self.run_input("small.toml", "--out", "y", "--set", "run.find='growth-rate'", environment=environment)
        self.assertIn("critical.png", self.entries("y"))
        self.assertNotIn("benard_grid.png", self.entries("y"))
        self.run_input("small.toml", "--out", "z", "--set", "fluid.rayleigh=[2000,3000,4000,5000,6000]",
                       environment=environment)
        self.assertIn("critical.png", self.entries("z"))


class Refusals(BenardGridTest):
    def test_unsound_settings(self):
        self.expect_refusals(
            ("fluid.rayleigh=0", "a number above 0"),
            ("fluid.rayleigh=nan", "fluid.rayleigh"),
            ("grid.cells=2", "from 4 to 1000"),
            ("run.step=9", "is unstable"),
            ("cell.width=11", "cells along x"),
            ("cell.hot=0.5", "must be above cell.cold"),
            ("fluid.equation_of_state='isentropic'", "van-der-waals"),
            ("run.find='all'", "growth-rate"),
            ("run.seed=5", "unknown key"))

    def test_check_and_explain_know_it(self):
        process = self.lucy("check", "small.toml")
        self.expect(process, 0)
        self.assertIn("ideal-gas, Ra = 5000, 10 cells", process.stdout)
        self.assertIn("node-steps", process.stdout)
        self.assertIn("wall time: at most about", process.stdout)
        process = self.lucy("explain", "--for", "benard-grid", "rayleigh")
        self.expect(process, 0)
        self.assertIn("Rayleigh number g alpha L^3", process.stdout)
        self.assertFalse((self.folder / "runs").exists())


class Promises(CommandPromises, BenardGridTest):
    OTHER = "cell.hot=1.6"
    LONGER = SMALL.replace("[6, 8, 10]", "[14, 18, 22]") + "[run]\nthreads = 2\ncheckpoint_interval = 0.05\n"


if __name__ == "__main__":
    unittest.main()

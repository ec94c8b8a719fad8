# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy benard`: kinetic energies and heat fluxes, flows that fail, refusals, interruptions."""

import json
import math
import re
import unittest

from running import CommandPromises, CommandTest

SMALL = """\
title = "two small cells"
[system]
particles = 200
[cell]
side = "periodic"
[fluid]
rayleigh = [3000, 5000]
[run]
equilibration = 200
duration = 800
seed = 4
[start]
disorder = 0.1
"""


# The rolls of the second point are faster than sound, and nobody watches its steps.
WILD = """
[[point]]
[[point]]
start.roll_velocity = 20
energy_tolerance = 1e6
equilibration = 0
sample_interval = 0.5
"""


class BenardTest(CommandTest):
    COMMAND = "benard"
    KIND = "benard run"
    SMALL = SMALL
    RESULTS = ("benard.csv", "notes.txt", "input.toml", "point_001.h5", "point_002.h5")

    def open_h5(self, name):
        try:
            import h5py
        except ImportError:
            self.skipTest("no h5py")
        return h5py.File(self.folder / name)


class Results(BenardTest):
    def test_the_table_says_what_was_asked_and_found(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.duration=2400")
        self.assertEqual(process.stderr, "")
        rows = self.table("x")
        self.assertEqual([float(row["rayleigh"]) for row in rows], [3000, 5000])
        words = ("equation_of_state", "kernel", "side", "wall", "density_mean", "status")
        for row in rows:
            self.assertEqual([row[word] for word in words],
                             ["ideal-gas", "lucy", "periodic", "mirror-images", "geometric", "ok"])
            number = {name: float(value) for name, value in row.items() if name not in words}
            self.assertEqual([number[name] for name in ("particles", "height", "width", "hot", "cold", "gravity")],
                             [200, 10, 20, 1.5, 0.5, 0.1])
            self.assertAlmostEqual(number["viscosity"], (100 / number["rayleigh"])**0.5, delta=1e-12)
            self.assertEqual(number["viscosity"], number["conductivity"])
            for name in ("total", "smoothed", "field"):
                self.assertGreater(number[f"kinetic_energy_{name}"], 0)
                self.assertGreater(number[f"kinetic_energy_{name}_error"], 0)
            self.assertLess(number["kinetic_energy_smoothed"], number["kinetic_energy_total"])
            for wall, sign in (("hot", 1), ("cold", -1)):
                self.assertAlmostEqual(number[f"nusselt_{wall}"],
                                       sign * (number[f"conduction_{wall}"] + number[f"work_{wall}"]), delta=1e-9)
                self.assertGreater(number[f"nusselt_{wall}"], 0.5)
            self.assertLess(abs(number["energy_imbalance"]), 0.1)
            self.assertEqual(number["nusselt_sides"], 0)
            self.assertGreater(number["temperature_least"], 0.3)
            self.assertLess(number["temperature_largest"], 1.7)
        self.assertIsNone(re.search(r"\de[-+]?\d", process.stdout.split("Reduced units")[0]))  # plain decimals
        for name in ("benard.csv", "point_002.h5", "provenance.json"):
            self.assertIn(name, process.stdout)
        record = json.loads((self.folder / "x" / "provenance.json").read_text())
        self.assertEqual(record["seed"], 4)

    def test_every_wall_weight_and_fluid_flows(self):
        self.write("kinds.toml", SMALL.replace("[3000, 5000]", "3000").replace("= 200\n[c", "= 196\n[c").replace(
            "duration = 800", "duration = 40\nstep = 0.1").replace('"periodic"', '"walls"') + """
[[point]]
wall = "boundary-particles"
[[point]]
equation_of_state = "van-der-waals"
kernel.name = "monaghan"
[[point]]
equation_of_state = "dense-fluid"
""")
        process = self.run_input("kinds.toml", "--out", "x")
        rows = self.table("x")
        self.assertEqual([row["wall"] for row in rows], ["boundary-particles", "mirror-images", "mirror-images"])
        self.assertEqual([row["equation_of_state"] for row in rows], ["ideal-gas", "van-der-waals", "dense-fluid"])
        for row in rows:
            self.assertEqual((float(row["height"]), float(row["width"])), (14, 14))
            self.assertNotEqual(float(row["nusselt_sides"]), 0)
            self.assertNotEqual(row["status"], "failed")
        self.assertIn("ideal-gas, walls, boundary-particles", process.stdout)
        self.assertIn("van-der-waals, walls, monaghan", process.stdout)
        self.assertIn("sides", process.stdout)

    def test_without_viscosity_the_rayleigh_number_is_infinite(self):
        self.write("thin.toml", SMALL.replace("rayleigh = [3000, 5000]", "viscosity = 0\nconductivity = 0.1").replace(
            "duration = 800", "duration = 50\nstep = 0.25"))
        process = self.run_input("thin.toml", "--out", "x")
        self.assertEqual(self.table("x")[0]["rayleigh"], "inf")
        self.assertIn("eta = 0, k = 0.1", process.stdout)
        again = self.run_input("thin.toml", "--out", "x")
        self.assertIn("nothing was run", again.stdout)

    def test_a_short_run_is_flagged_not_refused(self):
        self.run_input("small.toml", "--out", "x", "--set", "run.duration=5", "--set", "run.equilibration=0")
        self.assertEqual({row["status"] for row in self.table("x")}, {"short"})
        self.assertTrue(math.isnan(float(self.table("x")[0]["kinetic_energy_total_error"])))

    def test_the_point_file_holds_history_fields_and_the_last_state(self):
        self.run_input("small.toml", "--out", "x", "--set", "output.cells=8", "--set", "output.frame_interval=250",
                       "--set", "run.replicas=2")
        with self.open_h5("x/point_002.h5") as file:
            self.assertEqual(file["grid/x"].shape + file["grid/y"].shape, (16, 8))
            self.assertEqual(file["grid/y"][0], -4.375)
            self.assertEqual(file["fields/temperature"].shape, (8, 16))
            self.assertEqual(dict(file["fields"].attrs), {"time_from": 200, "time_to": 1000})
            self.assertGreater(file["fields/temperature"][0].mean(), file["fields/temperature"][-1].mean() + 0.4)
            self.assertAlmostEqual(file["fields/density"][()].mean(), 1, delta=0.02)
            self.assertEqual(file["last"].attrs["time"], 1000)
            self.assertEqual(file["last/position"].shape, (200, 2))
            self.assertLess(abs(file["last/position"][:, 1]).max(), 5.0)
            for name in ("velocity", "velocity_smoothed", "density", "temperature"):
                self.assertEqual(len(file["last"][name]), 200)
            for replica in ("replica_01", "replica_02"):
                series = file["observables"][replica]
                self.assertEqual(series["kinetic_energy_total/value"].shape, (200,))
                self.assertEqual(series["instants/temperature_least/time"][0], 5)
                self.assertEqual(series.attrs["averaged_from"], 200)
            self.assertEqual(list(file["particles/replica_01/position/time"]), [0, 250, 500, 750, 1000])
            self.assertEqual([bytes(word) for word in file["particles/replica_01/box"].attrs["boundary"]],
                             [b"periodic", b"none"])
            self.assertEqual(file["parameters"].attrs["rayleigh"], 5000)
        process = self.lucy("fields", "x/point_002.h5")
        self.expect(process, 2, "point_002.h5 is of particles between walls", "/fields")
        self.assertNotIn("point_002_fields", self.entries("x"))

    def test_a_flow_that_breaks_down_fails_with_all_before_it_on_disk(self):
        self.write("wild.toml", SMALL.replace("[3000, 5000]", "3000") + WILD)
        for _ in range(2):  # run, and printed again
            process = self.run_input("wild.toml", "--out", "x", code=1, says=("1 of 2 points failed",))
            self.assertRegex(process.stdout, r"failed: row 2 \(.*at time \d[^:]* particle \d+")
        rows = self.table("x")
        self.assertEqual([row["status"] == "failed" for row in rows], [False, True])
        self.assertGreater(float(rows[1]["kinetic_energy_total"]), 10)
        with self.open_h5("x/point_002.h5") as file:
            series = file["observables/replica_01"]
            self.assertGreater(len(series["kinetic_energy_total/value"]), 0)
            self.assertIn(b"at time", series.attrs["failure"])
            self.assertEqual(len(file["last/position"]), 200)

    def test_pictures(self):
        process = self.run_input("small.toml", "--out", "x", environment=self.environment(pictures=True))
        if "No pictures" in process.stdout:
            self.skipTest("no matplotlib")
        self.assertTrue((self.folder / "x" / "benard.png").read_bytes().startswith(b"\x89PNG"))


class Refusals(BenardTest):
    def test_unsound_settings(self):
        self.expect_refusals(
            ("fluid.rayleigh=0", "a number above 0"),
            ("system.particles=201", "make no square lattice"),
            ("cell.hot=0.5", "must be above cell.cold"),
            ("fluid.equation_of_state='isentropic'", "van-der-waals"),
            ("cell.wall='glass'", "boundary-particles"),
            ("run.step=2", "at most 1"),
            ("run.duration=nan", "run.duration"),
            ("output.sample_interval=0.7", "output.sample_interval"),
            ("grid.cells=20", "belongs to an input of `lucy benard-grid`"))

    def test_what_does_not_go_together(self):
        for setting, says in (("fluid.viscosity=1", "fluid.rayleigh = 3000 leaves nothing"),
                              ("cell.height=5", "in a cell of width 10 and height 5 make no square lattice"),
                              ("kernel.range=8", "cell.height = 10 must be above 2.9 times kernel.range = 8")):
            with self.subTest(setting):
                self.run_input("small.toml", "--out", "x", "--set", setting, code=2, says=("small.toml", says))

    def test_a_cold_van_der_waals_fluid_would_fall_into_drops(self):
        self.run_input("small.toml", "--set", "fluid.equation_of_state='van-der-waals'", "--set", "cell.cold=0.2",
                       code=2, says=("cell.cold = 0.2 must be above",))

    def test_inputs_of_particles_and_of_the_continuum_are_told_apart(self):
        self.run_input("small.toml", command="benard-grid", code=2, says=("belongs to an input of", "`lucy benard`"))
        self.write("grid.toml", "[cell]\nheight = 10\n[fluid]\nrayleigh = 3000\n[grid]\ncells = 8\n")
        self.run_input("grid.toml", code=2, says=("unknown section [grid]", "`lucy benard-grid`"))
        for name, unit in (("small.toml", "particle-steps"), ("grid.toml", "node-steps")):
            process = self.lucy("check", name)
            self.expect(process, 0)
            self.assertIn(unit, process.stdout)

    def test_check_and_explain_know_it(self):
        process = self.lucy("check", "small.toml")
        self.expect(process, 0)
        self.assertIn("ideal-gas, 200 particles, Ra = 5000", process.stdout)
        self.assertIn("wall time", process.stdout)
        process = self.lucy("explain", "--for", "benard", "wall")
        self.expect(process, 0)
        self.assertIn("boundary-particles", process.stdout)
        self.assertFalse((self.folder / "runs").exists())


class Promises(CommandPromises, BenardTest):
    LONGER = SMALL.replace("duration = 800", "duration = 300").replace(
        "seed = 4", "seed = 4\nreplicas = 2\nthreads = 2\ncheckpoint_interval = 0.05") + (
            "[output]\nframe_interval = 250\n")


if __name__ == "__main__":
    unittest.main()

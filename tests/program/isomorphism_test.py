# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy isomorphism`: the verdict and its exit code, results that no thread or interruption changes, refusals."""

import json
import math
import unittest

from running import CommandPromises, CommandTest

SMALL = """\
title = "free and sheared"
[system]
particles = 100
energy_per_particle = 1
[isentropic]
pressure = 1
[shear]
strain_rate = [0, 0.5]
[run]
equilibration = 5
duration = 60
seed = 4
"""


class IsomorphismTest(CommandTest):
    COMMAND = "isomorphism"
    KIND = "isomorphism run"
    SMALL = SMALL
    RESULTS = ("isomorphism.csv", "notes.txt", "input.toml")


class Results(IsomorphismTest):
    def test_every_bit_is_the_same_and_both_readings_stand_side_by_side(self):
        process = self.run_input("small.toml", "--out", "x")
        self.assertEqual(process.stderr, "")
        for rate in ("0", "0.5"):
            # 1300 steps and the start; 6 numbers per particle and 5 sums.
            self.assertIn(f"N = 100, E/N = 1, rate {rate}: identical in every bit: 1300 steps x 100 particles, "
                          f"{1301 * 605} comparisons", process.stdout)
        for words in ("Reynolds stress", "SPAM pressure tensor", "viscosity, kinetic", "viscosity, potential",
                      "of it in the smoothed velocity", "of it the self term"):
            self.assertIn(words, process.stdout)
        self.assertNotRegex(process.stdout, r"\de[-+]?\d")  # plain decimals
        rows = self.table("x")
        self.assertEqual([row["identical"] for row in rows], ["yes", "yes"])
        self.assertEqual([row["thermostat"] for row in rows], ["none", "isoenergetic"])
        self.assertEqual({row["difference_component"] for row in rows}, {"none"})
        self_term = 5 / (math.pi * 9) / 2
        for row in rows:
            number = {name: float(value) for name, value in row.items()
                      if name not in ("thermostat", "identical", "difference_component", "status")}
            self.assertAlmostEqual(number["smooth_internal_energy"], number["atoms_potential_energy"] + self_term,
                                   delta=1e-12)
            self.assertEqual(row["smooth_pxy_tensor"], row["atoms_pxy_potential"])
            self.assertEqual(row["smooth_pxy_reynolds"], row["atoms_pxy_kinetic"])
            self.assertGreater(number["atoms_pxy_kinetic_error"], 0)
        self.assertEqual(rows[0]["atoms_viscosity"], "nan")
        self.assertGreater(float(rows[1]["atoms_viscosity_error"]), 0)
        self.assertEqual(json.loads((self.folder / "x" / "provenance.json").read_text())["seed"], 4)
        self.assertEqual(self.entries("x"),
                         [".lock", "input.toml", "isomorphism.csv", "notes.txt", "provenance.json"])

    def test_another_fluid_differs_at_the_start(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "isentropic.pressure=2", code=1,
                                 says=("2 of 2 cases",))
        self.assertIn("not identical: at the start, F_x of particle 0", process.stdout)
        self.assertNotIn("identical in every bit", process.stdout)
        row, _ = self.table("x")
        self.assertEqual((row["identical"], row["difference_step"], row["difference_component"]), ("no", "0", "F_x"))
        self.assertEqual(float(row["difference_smooth"]), 2 * float(row["difference_atoms"]))
        again = self.run_input("small.toml", "--out", "x", "--set", "isentropic.pressure=2", code=1)
        self.assertIn("not identical: at the start, F_x of particle 0", again.stdout)
        self.assertIn("nothing was run", again.stdout)

    def test_a_fluid_with_the_same_coefficient_does_not(self):
        self.run_input("small.toml", "--out", "x")
        self.run_input("small.toml", "--out", "y", "--set", "isentropic.pressure=4", "--set",
                       "isentropic.reference_density=2")
        for one, other in zip(self.table("x"), self.table("y")):
            self.assertEqual((other.pop("isentropic_pressure"), other.pop("isentropic_reference_density")), ("4", "2"))
            self.assertEqual((one.pop("isentropic_pressure"), one.pop("isentropic_reference_density")), ("1", "1"))
            self.assertEqual(one, other)

    def test_a_short_run_is_flagged_not_refused(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.duration=1")
        self.assertEqual({row["status"] for row in self.table("x")}, {"short"})
        self.assertIn("identical in every bit", process.stdout)
        self.assertIn("too short for an error bar", process.stdout)

    def test_a_case_that_fails_does_not_stop_the_other(self):
        process = self.run_input("small.toml", "--out", "x", "--set", "run.energy_tolerance=1e-16", "--set",
                                 "shear.strain_rate=[0.5,1]", "--set", "run.step=0.2", code=1, says=("failed",))
        self.assertIn("failed: at time", process.stdout)
        self.assertEqual({row["identical"] for row in self.table("x")}, {"unknown"})


class Refusals(IsomorphismTest):
    def test_unsound_cases(self):
        self.expect_refusals(
            ("isentropic.pressure=3", "must be a power of two"),
            ("isentropic.reference_density=0", "must be a number above 0"),
            ("system.reading='spam'", "unknown key 'reading'"),
            ("system.particles=25", "below twice kernel.range"),
            ("run.step=0.3", "run.step"),
            ("run.duration=nan", "run.duration"),
            ("shear.thermostat='cold'", "nose-hoover"))

    def test_check_and_explain_know_it(self):
        for extra in ((), ("--for", "isomorphism")):
            process = self.lucy("check", "small.toml", *extra)
            self.expect(process, 0)
            self.assertIn("rho0", process.stdout)
            self.assertIn("wall time", process.stdout)
        process = self.lucy("explain", "--for", "isomorphism", "isentropic")
        self.expect(process, 0)
        self.assertIn("[isentropic]", process.stdout)
        self.assertIn("power of two", process.stdout)
        self.assertFalse((self.folder / "runs").exists())


class Promises(CommandPromises, IsomorphismTest):
    LONGER = SMALL.replace("duration = 60", "duration = 600").replace(
        "seed = 4", "seed = 4\nreplicas = 2\nthreads = 2\ncheckpoint_interval = 0.05")


if __name__ == "__main__":
    unittest.main()

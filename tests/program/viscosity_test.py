# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy viscosity`: a sweep and a Green-Kubo run, written by hand here, side by side."""

import csv
import fcntl
import math
import os
import unittest

from running import ProgramTest

SWEEP_QUANTITIES = ("potential_energy", "kinetic_temperature", "pxy_kinetic", "pxy_potential", "pxx_kinetic",
                    "pxx_potential", "pyy_kinetic", "pyy_potential", "viscosity", "normal_stress", "largest_kinetic_share")
GREEN_KUBO_QUANTITIES = ("viscosity", "viscosity_half_cutoff", "viscosity_twice_cutoff", "viscosity_spectrum",
                         "viscosity_kinetic", "viscosity_cross", "viscosity_potential", "viscosity_xy",
                         "viscosity_difference", "decay_time", "kinetic_temperature", "pressure", "pressure_kinetic",
                         "pressure_potential", "potential_energy", "shear_modulus", "self_diffusion",
                         "thermal_conductivity")
RESULTS = ["nemd.csv", "sweep_fit.csv", "viscosities.csv"]

# Viscosities at E = N, N = 1024: rate, value, error, largest share of the kinetic energy.
SHEARED = [(0.001, 12.69, 0.54, 0.007), (0.002, 13.23, 0.45, 0.008), (0.005, 13.02, 0.23, 0.008),
           (0.010, 9.4, 7.1, 0.6), (0.02, 8.85, 0.062, 0.06), (0.05, 5.021, 0.021, 0.02)]

STATE = "[system]\nparticles = 1024\nenergy_per_particle = 1\ndensity = {density}\n[run]\nduration = 2000\n"


def with_errors(names):
    return [column for name in names for column in (name, f"{name}_error")]


class SideBySide(ProgramTest):
    def setUp(self):
        super().setUp()
        self.sweep_directory()
        self.green_kubo_directory()

    def write_table(self, path, rows):
        path.parent.mkdir(exist_ok=True)
        with open(path, "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)

    def sweep_directory(self, name="sheared", energy=1, rows=SHEARED):
        table = []
        for rate, viscosity, error, share in rows:
            row = {"particles": 1024, "energy_per_particle": energy, "strain_rate": rate, "step": 0.05, "duration": 20000,
                   "replicas": 2}
            row |= {column: 0.1 for column in with_errors(SWEEP_QUANTITIES)}
            row |= {"viscosity": viscosity, "viscosity_error": error, "largest_kinetic_share": share}
            row |= {"effective_samples": 100, "equilibration_discarded": 0, "worst_energy_error": 1e-6,
                    "subdivided_steps": 0, "status": "ok"}
            table.append(row)
        self.write_table(self.folder / name / "table.csv", table)

    def green_kubo_directory(self, name="rest", energies=(1,)):
        table = []
        for energy in energies:
            row = {"energy_per_particle": energy, "particles": 1024}
            row |= {column: "nan" for column in with_errors(GREEN_KUBO_QUANTITIES)}
            row |= {"viscosity": 13.5, "viscosity_error": 0.4, "viscosity_spectrum": 13.2, "viscosity_spectrum_error": 0.5,
                    "kinetic_temperature": 0.54, "kinetic_temperature_error": 0.001, "pressure": 1.0238,
                    "pressure_error": 0.0001, "pressure_kinetic": 0.5392, "pressure_kinetic_error": 0.0001}
            row |= {"spectrum_z": 0.75, "cutoff": 154, "decay_begin": 5, "decay_end": 80, "spectrum_frequency": 0.05,
                    "spectrum_p_value": 0.5, "self_diffusion_cutoff": math.nan,
                    "thermal_conductivity_cutoff": math.nan, "blocks": 64, "step": 0.05, "sample_interval": 0.2, "duration": 20000,
                    "replicas": 8, "energy_drift": 1e-6, "largest_energy_error": 1e-5, "status": "ok"}
            table.append(row)
        self.write_table(self.folder / name / "viscosity.csv", table)

    def viscosity(self, *arguments, code=0, says=(), **options):
        process = self.lucy("viscosity", *arguments, **options)
        self.expect(process, code, *says)
        return process

    def routes(self, directory):
        with open(self.folder / directory / "viscosities.csv", newline="") as file:
            return {row["route"]: row for row in csv.DictReader(file)}


class Answers(SideBySide):
    def test_every_route_stands_beside_green_kubo(self):
        process = self.viscosity("sheared", "rest")
        self.assertEqual(process.stderr, "")
        routes = self.routes("rest")
        self.assertEqual(list(routes), ["nemd", "green-kubo", "green-kubo-spectrum", "published-green-kubo",
                                        "weak-scattering"])
        for route in routes:
            self.assertIn(route, process.stdout)
        self.assertEqual((routes["green-kubo"]["viscosity"], routes["green-kubo"]["viscosity_error"]), ("13.5", "0.4"))
        nemd = {name: float(routes["nemd"][name]) for name in ("viscosity", "viscosity_error", "z")}
        self.assertAlmostEqual(nemd["viscosity"], 12.9867, delta=1e-3)  # an independent fit with numpy
        self.assertAlmostEqual(nemd["viscosity_error"], 0.3889, delta=1e-3)
        self.assertAlmostEqual(nemd["z"], (nemd["viscosity"] - 13.5) / math.hypot(nemd["viscosity_error"], 0.4), places=9)
        self.assertEqual(float(routes["green-kubo-spectrum"]["z"]), -0.75)
        self.assertEqual(routes["published-green-kubo"]["viscosity"], "14")
        self.assertAlmostEqual(float(routes["weak-scattering"]["viscosity"]), 35 * 0.54 ** 1.5, places=9)
        with open(self.folder / "rest" / "sweep_fit.csv", newline="") as file:
            parts = [row["part"] for row in csv.DictReader(file)]
        self.assertEqual(parts, ["fitted"] * 3 + ["unstable"] + ["beyond"] * 2)
        with open(self.folder / "rest" / "nemd.csv", newline="") as file:
            row, = csv.DictReader(file)
        self.assertEqual((row["viscosity"], row["viscosity_error"]),
                         (routes["nemd"]["viscosity"], routes["nemd"]["viscosity_error"]))
        for line in process.stdout.splitlines():
            self.assertLessEqual(len(line), 120, line)

    def test_the_files_themselves_may_be_given(self):
        self.viscosity("sheared", "rest", "--out", "one")
        self.viscosity("sheared/table.csv", "rest/viscosity.csv", "--out", "two")
        self.assertEqual(self.contents("one", RESULTS), self.contents("two", RESULTS))
        self.assertEqual(self.entries("rest"), ["viscosity.csv"])
        self.viscosity("sheared/table.csv", "viscosity.csv", code=2, says=["viscosity.csv"])
        (self.folder / "rest" / "viscosity.csv").rename(self.folder / "viscosity.csv")
        self.viscosity("sheared/table.csv", "viscosity.csv")
        self.assertTrue(set(RESULTS) <= set(self.entries()))

    def test_earlier_answers_are_replaced_and_nothing_else(self):
        (self.folder / "rest" / "mine.txt").write_text("keep")
        table = (self.folder / "rest" / "viscosity.csv").read_bytes()
        self.viscosity("sheared", "rest")
        first = self.contents("rest", RESULTS)
        for name in RESULTS + ["viscosities.png"]:
            (self.folder / "rest" / name).write_text("old")
        self.viscosity("sheared", "rest")
        self.assertEqual(self.contents("rest", RESULTS), first)
        self.assertNotIn("viscosities.png", self.entries("rest"))  # an old picture never stands beside new numbers
        self.assertEqual((self.folder / "rest" / "mine.txt").read_text(), "keep")
        self.assertEqual((self.folder / "rest" / "viscosity.csv").read_bytes(), table)

    def test_a_sweep_far_from_zero_rate_says_so(self):
        self.sweep_directory("quick", rows=[(0.05, 5.021, 0.021, 0.02), (0.1, 2.6407, 0.0042, 0.01),
                                            (0.2, 1.2544, 0.0018, 0.01), (0.5, 0.42174, 0.00044, 0.01)])
        process = self.viscosity("quick", "rest")
        self.assertIn("no value: even the lowest rates, 0.05 to 0.2", " ".join(process.stdout.split()))
        self.assertEqual(self.routes("rest")["nemd"]["viscosity"], "nan")

    def test_states_of_one_table_alone_are_named(self):
        self.green_kubo_directory(energies=(0.5, 1))
        process = self.viscosity("sheared", "rest")
        self.assertIn("Only in rest/viscosity.csv: N = 1024, E/N = 0.5.\n", process.stdout)
        self.assertNotIn("Only in sheared", process.stdout)
        self.assertEqual(self.routes("rest")["nemd"]["energy_per_particle"], "1")

    def test_pictures_are_drawn_or_the_command_is_printed(self):
        process = self.viscosity("sheared", "rest")
        self.assertIn("plot_viscosities.py rest", process.stdout)
        process = self.viscosity("sheared", "rest", environment=self.environment(pictures=True))
        if "No pictures" not in process.stdout:
            for name in ("viscosities.png", "viscosities.svg"):
                self.assertIn(name, self.entries("rest"))
                self.assertIn(name, process.stdout)


class Fluids(SideBySide):
    def inputs(self, sheared, rest):
        self.write("sheared/input.toml", STATE.format(density=sheared) + "[shear]\nstrain_rate = 0.1\n")
        self.write("rest/input.toml", STATE.format(density=rest))

    def test_of_the_same_kind_are_laid_side_by_side(self):
        self.inputs(1, 1.0)
        self.viscosity("sheared", "rest")
        self.assertEqual(len(self.routes("rest")), 5)

    def test_that_print_does_not_know_are_not_compared_with_print(self):
        self.inputs(0.9, 0.9)
        self.viscosity("sheared", "rest")
        self.assertEqual(list(self.routes("rest")), ["nemd", "green-kubo", "green-kubo-spectrum"])

    def test_that_differ_are_refused(self):
        self.inputs(1, 0.9)
        self.viscosity("sheared", "rest", code=2, says=["N = 1024, E/N = 1", "sheared/input.toml has density 1",
                                                        "rest/input.toml has density 0.9"])
        self.assertEqual(self.entries("rest"), ["input.toml", "viscosity.csv"])


class Refusals(SideBySide):
    def test_no_common_state(self):
        self.sweep_directory(energy=0.75)
        self.viscosity("sheared", "rest", code=2, says=["no state of sheared/table.csv (N = 1024, E/N = 0.75)",
                                                        "rest/viscosity.csv (N = 1024, E/N = 1)"])
        self.assertEqual(self.entries("rest"), ["viscosity.csv"])

    def test_directories_that_hold_something_else(self):
        self.viscosity("rest", "sheared", code=2, says=["rest holds no table.csv", "first the sweep"])
        self.viscosity("sheared", "sheared", code=2, says=["sheared holds no viscosity.csv"])
        self.viscosity("sheared", "nowhere", code=2, says=["nowhere"])
        self.viscosity("sheared/table.csv", "sheared/table.csv", code=2, says=["sheared/table.csv:1"])

    def test_one_result_is_not_enough(self):
        self.viscosity("sheared", code=2, says=["viscosity"])

    def test_a_directory_in_use(self):
        with open(self.folder / "rest" / ".lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.viscosity("sheared", "rest", code=2, says=["another lucy", "--out"])
            self.viscosity("sheared", "rest", "--out", "elsewhere")
        self.assertNotIn("viscosities.csv", self.entries("rest"))

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_directory_that_may_not_be_written(self):
        (self.folder / "rest").chmod(0o500)
        self.addCleanup((self.folder / "rest").chmod, 0o700)
        self.viscosity("sheared", "rest", code=2, says=["Permission denied", "--out"])

    def test_a_file_in_the_place_of_the_directory(self):
        self.viscosity("sheared", "rest", "--out", "tiny.toml", code=2, says=["tiny.toml", "--out"])


if __name__ == "__main__":
    unittest.main()

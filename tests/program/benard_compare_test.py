# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy benard-compare`: particles and grids, written by hand here, side by side with print."""

import csv
import fcntl
import math
import unittest

from running import SOURCE, ProgramTest

QUANTITIES = ("kinetic_energy_field", "nusselt_hot", "nusselt_cold", "nusselt_sides", "energy_imbalance",
              "kinetic_energy_total", "conduction_hot", "work_hot", "conduction_cold", "work_cold", "conduction_sides",
              "work_sides", "stored", "kinetic_energy_smoothed", "internal_energy", "total_energy", "roll_amplitude",
              "density_least", "density_largest", "temperature_least", "temperature_largest")
CELL = {"equation_of_state": "ideal-gas", "side": "periodic", "height": 50, "width": 100, "hot": 1.5, "cold": 0.5,
        "gravity": 0.02, "roll_velocity": 0.085}


def fluid(rayleigh, viscosity=None, conductivity=None):
    eta = viscosity or math.sqrt(2500 / rayleigh)
    return CELL | {"rayleigh": rayleigh, "viscosity": eta, "conductivity": conductivity or eta}


def particle_row(rayleigh, total=0.00451, error=0.00002):
    row = fluid(rayleigh) | {"particles": 5000, "kernel": "lucy", "range": 3, "wall": "mirror-images",
                             "bulk_viscosity": 0, "disorder": 0, "step": 0.5, "density_mean": "geometric",
                             "duration": 3000, "replicas": 1, "equilibration": 3000}
    row |= {column: 0.1 for name in QUANTITIES for column in (name, f"{name}_error")}
    row |= {"kinetic_energy_total": total, "kinetic_energy_total_error": error,
            "kinetic_energy_smoothed": 0.9 * total, "kinetic_energy_smoothed_error": error,
            "kinetic_energy_field": 0.88 * total, "kinetic_energy_field_error": error,
            "nusselt_hot": 1.7, "nusselt_hot_error": 0.01, "nusselt_cold": 1.71, "nusselt_cold_error": 0.01}
    return row | {"effective_samples": 100, "equilibration_discarded": 0, "worst_energy_error": 1e-6,
                  "energy_drift": 1e-6, "subdivided_steps": 0, "reflections": 10, "status": "ok"}


def grid_rows(rayleigh, kinetic_energy, **coefficients):
    """On three meshes, exactly on the line in 1/cells^2."""
    return [fluid(rayleigh, **coefficients) | {
        "find": "steady-state", "transport": "dynamic", "cells": cells, "step": 0.3, "duration": 9000, "time": 9000,
        "kinetic_energy": kinetic_energy + 0.02 / cells ** 2, "nusselt_hot": 1.8, "nusselt_cold": 1.8,
        "nusselt_sides": 0, "largest_speed": 0.19, "energy_imbalance": 0.001, "mass_error": 1e-15, "change": 1e-9,
        "growth_rate": "nan", "growth_rate_error": "nan", "status": "ok"} for cells in (20, 40, 60)]


class SideBySide(ProgramTest):
    def setUp(self):
        super().setUp()
        self.table("particles/benard.csv", [particle_row(10000), particle_row(5000, 0.00311)])
        self.table("grid/benard_grid.csv", grid_rows(5000, 0.0034) + grid_rows(10000, 0.00489))

    def table(self, name, rows):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)

    def compare(self, *arguments, code=0, says=(), **options):
        process = self.lucy("benard-compare", *arguments, **options)
        self.expect(process, code, *says)
        return process

    def lines(self, directory="particles"):
        """(Rayleigh number, quantity, beside) and its line."""
        with open(self.folder / directory / "benard_compare.csv", newline="", encoding="utf-8") as file:
            return {(float(row["rayleigh"]), row["quantity"], row["beside"]): row for row in csv.DictReader(file)}


class Answers(SideBySide):
    def test_particles_grid_and_print_stand_side_by_side(self):
        process = self.compare("particles", "grid")
        self.assertEqual(process.stderr, "")
        lines = self.lines()
        self.assertEqual(len(lines), 2 * (5 + 1 + 1))
        total = {name: float(lines[10000, "kinetic_energy_total", "grid"][name])
                 for name in ("value", "value_error", "beside_value", "beside_error", "per_cent", "z")}
        self.assertAlmostEqual(total["beside_value"], 0.00489, delta=1e-12)
        self.assertAlmostEqual(total["per_cent"], 100 * (0.00451 / 0.00489 - 1), places=6)
        self.assertAlmostEqual(total["z"], (0.00451 - 0.00489) / 0.00002, places=3)
        print_of_particles = lines[5000, "kinetic_energy_total", "published"]
        self.assertEqual(float(print_of_particles["beside_value"]), 0.0030)
        self.assertAlmostEqual(float(print_of_particles["z"]), 0.00011 / math.hypot(0.00002, 1e-4 / math.sqrt(12)),
                               places=6)
        self.assertEqual(float(lines[10000, "kinetic_energy_continuum", "published"]["beside_value"]), 0.00481)
        for piece in ("ideal-gas, N = 5000, Ra = 10000", "Ra = 5000", "0.004510(20)", "-7.77", "0.00481", "print"):
            self.assertIn(piece, process.stdout)
        for line in process.stdout.splitlines():
            self.assertLessEqual(len(line), 120, line)

    def test_the_order_of_directories_does_not_matter(self):
        self.compare("particles", "grid", "--out", "one")
        self.compare("grid", "particles", "--out", "two")
        self.assertEqual(self.contents("one", ["benard_compare.csv"]), self.contents("two", ["benard_compare.csv"]))
        self.assertEqual(self.entries("particles"), ["benard.csv"])

    def test_without_a_grid_print_alone_stands_there(self):
        process = self.compare("particles")
        self.assertEqual({beside for _, _, beside in self.lines()}, {"published"})
        self.assertIn("no grid: ideal-gas, N = 5000, Ra = 10000", " ".join(process.stdout.split()))

    def test_effective_coefficients_get_their_own_column(self):
        effective = {10000: (0.65, 0.52), 5000: (0.86, 0.73)}
        rows = [row for ra, (eta, k) in effective.items()
                for row in grid_rows(2500 / (eta * k), 0.0045 if ra == 10000 else 0.003, viscosity=eta, conductivity=k)]
        self.table("effective/benard_grid.csv", rows)
        process = self.compare("particles", "grid", "--effective", "effective")
        lines = self.lines()
        for ra, value in ((10000, 0.0045), (5000, 0.003)):
            line = lines[ra, "kinetic_energy_total", "effective-grid"]
            self.assertAlmostEqual(float(line["beside_value"]), value, delta=1e-12)
            self.assertAlmostEqual(float(line["beside_rayleigh"]), 2500 / math.prod(effective[ra]), places=6)
        self.assertIn("effective grid", process.stdout)
        self.table("effective/benard_grid.csv", rows[:3])
        self.compare("particles", "grid", "--effective", "effective", code=2,
                     says=["at 1 Rayleigh number in the cell of 50 x 100, where particles have 2"])

    def test_other_published_values_may_be_given(self):
        text = (SOURCE / "reference" / "kum1995_benard.csv").read_text(encoding="utf-8")
        self.write("mine.csv", text.replace("0.0046", "0.0050"))
        process = self.compare("particles", "grid", "--published", "mine.csv")
        self.assertEqual(self.lines()[10000, "kinetic_energy_total", "published"]["beside_value"], "0.005")
        self.assertIn("--published mine.csv", process.stdout)  # as the pictures are to have it
        self.compare("particles", "grid", "--published", "nowhere.csv", code=2, says=["nowhere.csv"])

    def test_earlier_answers_are_replaced_and_nothing_else(self):
        self.compare("particles", "grid")
        first = self.contents("particles", ["benard_compare.csv"])
        for name in ("benard_compare.csv", "benard_compare.png", "benard_compare_fields_007.svg", "mine.png"):
            self.write(f"particles/{name}", "old")
        self.compare("particles", "grid")
        self.assertEqual(self.contents("particles", ["benard_compare.csv"]), first)
        self.assertEqual(self.entries("particles"), [".lock", "benard.csv", "benard_compare.csv", "mine.png"])

    def test_pictures_are_drawn_or_the_command_is_printed(self):
        self.assertIn("plot_benard_compare.py particles grid --out particles", self.compare("particles", "grid").stdout)
        process = self.compare("particles", "grid", environment=self.environment(pictures=True))
        if "No pictures" not in process.stdout:
            for name in ("benard_compare.png", "benard_compare.svg"):
                self.assertIn(name, self.entries("particles"))
                self.assertIn(name, process.stdout)


class Refusals(SideBySide):
    def test_directories_that_hold_something_else(self):
        self.compare("particles", ".", code=2, says=[". holds neither a benard.csv nor a benard_grid.csv"])
        self.compare("nowhere", code=2, says=["nowhere"])
        self.compare("grid", code=2, says=["no particles to lay beside the grid"])
        self.compare("particles", "--effective", "particles", code=2, says=["--effective particles", "benard_grid.csv"])

    def test_a_directory_given_twice(self):
        self.compare("particles", "grid", "./particles", code=2, says=["is given twice"])

    def test_nothing_in_common(self):
        self.table("particles/benard.csv", [particle_row(12345)])
        self.compare("particles", "grid", code=2, says=["nothing to lay beside ideal-gas, N = 5000, Ra = 12345"])
        self.assertEqual(self.entries("particles"), ["benard.csv"])

    def test_a_table_that_cannot_be_read(self):
        text = (self.folder / "particles" / "benard.csv").read_text(encoding="utf-8")
        self.write("particles/benard.csv", text.replace("0.00451", "much"))
        self.compare("particles", "grid", code=2, says=["benard.csv:2", "kinetic_energy_total", "much"])

    def test_a_directory_in_use(self):
        with open(self.folder / "particles" / ".lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.compare("particles", "grid", code=2, says=["another lucy", "--out"])
            self.compare("particles", "grid", "--out", "elsewhere")

    def test_no_directory_at_all(self):
        self.compare(code=2, says=["DIRECTORY"])


if __name__ == "__main__":
    unittest.main()

# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of convection, of particles alone and beside the grid, on small made-up results. Exit code 77 (skipped)
without numpy, matplotlib and h5py."""

import math
import os
import subprocess
import sys
import unittest
import unittest.mock

from green_kubo_plots_test import NAN, SCRIPTS, PictureTest, csv_text  # and the skipping

try:
    import h5py
except ImportError:
    print("skipped: /usr/bin/python3 lacks h5py")
    sys.exit(77)
import numpy as np

import benard_flows
import plot_benard
import plot_benard_compare

PARTICLE_COLUMNS = tuple(dict.fromkeys((*plot_benard.VALUES, *plot_benard.NAMES, *plot_benard_compare.PARTICLE_NUMBERS,
                                        *plot_benard_compare.PARTICLE_WORDS)))
GRID_COLUMNS = (*benard_flows.NUMBERS, "cells", *benard_flows.WORDS, "transport", "find")
LIMIT_COLUMNS = (*plot_benard_compare.LIMIT_WORDS, *plot_benard_compare.LIMIT_NUMBERS)
CRITICAL_COLUMNS = (*plot_benard_compare.LIMIT_WORDS, "height", "width", "hot", "cold", "route", "critical_rayleigh")


def fluid(rayleigh=10000, height=8, side="periodic", **changes):
    eta = height / math.sqrt(rayleigh)
    return {"equation_of_state": "ideal-gas", "side": side, "height": height,
            "width": height * (2 if side == "periodic" else 1), "hot": 1.5, "cold": 0.5, "gravity": 1 / height,
            "rayleigh": rayleigh, "viscosity": eta, "conductivity": eta, "status": "ok", "transport": "dynamic",
            "find": "steady-state", **changes}


def particles(rayleigh=10000, energy=0.0045, **changes):
    row = fluid(rayleigh, **changes)
    row = {"particles": row["width"] * row["height"], "kernel": "lucy", "range": 3, "wall": "mirror-images"} | row
    for name, part in (("total", 1), ("smoothed", 0.9), ("field", 0.88)):
        row.setdefault(f"kinetic_energy_{name}", part * energy)
        row[f"kinetic_energy_{name}_error"] = 0.00002
    return row


def rolls(row, x, y):
    """Density, temperature and velocities there."""
    height = row["height"]
    up = np.cos(np.pi * x / height) * np.cos(np.pi * y / height)
    temperature = 1 - y / height + 0.2 * up
    return {"density": 1 - 0.1 * up, "temperature": temperature, "velocity_y": 0.1 * up,
            "velocity_x": 0.1 * np.sin(np.pi * x / height) * np.sin(2 * np.pi * y / height)}


class ConvectionTest(PictureTest):
    def table(self, name, columns, rows):
        self.write(name, csv_text(columns, [[row[column] for column in columns] for row in rows]))

    def particles(self, *rows, without=(), folder="."):
        """benard.csv and point files; `without` names groups that these lack."""
        (self.folder / folder).mkdir(exist_ok=True)
        self.table(f"{folder}/benard.csv", PARTICLE_COLUMNS, rows)
        for index, row in enumerate(rows):
            with h5py.File(self.folder / folder / f"point_{index + 1:03d}.h5", "w") as file:
                self.write_particles(file, row)
                for group in without:
                    del file[group]

    @staticmethod
    def write_particles(file, row):
        width, height = row["width"], row["height"]
        x = (np.arange(12) + 0.5) * width / 12 - width / 2
        y = (np.arange(6) + 0.5) * height / 6 - height / 2
        file["grid/x"], file["grid/y"] = x, y
        for name, field in rolls(row, *np.meshgrid(x, y)).items():
            file[f"fields/{name}"] = field
        file["fields"].attrs.update({"time_from": 50.0, "time_to": 100.0})
        generator = np.random.default_rng(4)
        position = (generator.random((int(row["particles"]), 2)) - 0.5) * [width, height]
        flow = rolls(row, *position.T)
        velocity = np.stack((flow["velocity_x"], flow["velocity_y"]), axis=1)
        file["last/position"], file["last/velocity_smoothed"] = position, velocity
        file["last/velocity"] = velocity + 0.02 * generator.standard_normal(velocity.shape)
        file["last/density"], file["last/temperature"] = flow["density"], flow["temperature"]
        file["last"].attrs["time"] = 100.0
        times = np.arange(1, 21) * 5.0
        for name, folder in (("kinetic_energy_total", ""), ("kinetic_energy_smoothed", "instants/")):
            element = file.create_group(f"observables/replica_01/{folder}{name}")
            element["time"] = times
            element["value"] = row[name] * (1 - np.exp(-times / 10))

    def grid(self, *rows, folder="grid", limits=True, end=None):
        """benard_grid.csv and point files of 8 cells; extrapolated.csv; critical.csv with `end`."""
        (self.folder / folder).mkdir(exist_ok=True)
        rows = [{"cells": 8, "kinetic_energy": 0.0049} | row for row in rows]
        self.table(f"{folder}/benard_grid.csv", GRID_COLUMNS, rows)
        for index, row in enumerate(rows):
            with h5py.File(self.folder / folder / f"point_{index + 1:03d}.h5", "w") as file:
                x = np.linspace(-row["width"] / 2, row["width"] / 2, 2 * row["cells"] + 1)
                y = np.linspace(-row["height"] / 2, row["height"] / 2, row["cells"] + 1)
                file["grid/x"], file["grid/y"] = x, y
                for name, field in rolls(row, *np.meshgrid(x, y)).items():
                    file[f"fields/{name}"] = field
                file["history/time"] = np.arange(30) * 5.0
                file["history/kinetic_energy"] = row["kinetic_energy"] * (1 - np.exp(-np.arange(30) / 2))
        if limits:
            self.table(f"{folder}/extrapolated.csv", LIMIT_COLUMNS, rows)
        if end is not None:
            critical = rows[0] | {"route": "straight-line", "critical_rayleigh": end}
            self.table(f"{folder}/critical.csv", CRITICAL_COLUMNS, [critical])

    def pictures(self, folder="."):
        return sorted(path.name for path in (self.folder / folder).glob("*.png"))


class OfParticles(ConvectionTest):
    def test_one_fluid_has_averages_particles_and_kinetic_energies(self):
        self.particles(particles())
        self.assertEqual(self.draw(plot_benard), "")
        texts = self.texts("benard")
        for text in ("total", "smoothed", "of the averaged flow", "averaged on a grid, mean over time 50 to 100",
                     "at the particles, time 100 (velocities smoothed)"):
            self.assertIn(text, texts)
        self.assertTrue(any("ideal gas, Ra = 10000, " in text for text in texts), texts)
        self.assertTrue(any(text.startswith("velocity, longest arrow") for text in texts), texts)
        self.assertEqual(self.pictures(), ["benard.png"])

    def test_several_fluids_have_a_row_each_and_a_picture_for_themselves(self):
        self.particles(particles(), particles(5000), particles(20000, side="walls"),
                       particles(kernel="monaghan", range=4, wall="boundary-particles"))
        self.assertEqual(self.draw(plot_benard), "")
        self.assertEqual(self.pictures(), ["benard.png", *(f"benard_00{index}.png" for index in range(1, 5))])
        texts = self.texts("benard")
        for piece in ("Ra = 5000", "Ra = 20000", "Monaghan's weight", "boundary particles"):
            self.assertTrue(any(piece in text for text in texts), (piece, texts))
        self.assertFalse(any("at the particles" in text for text in texts), texts)

    def test_more_rows_than_can_be_read_are_said_to_be_missing(self):
        self.particles(*(particles(1000 * index) for index in range(2, 5)))
        with unittest.mock.patch.object(plot_benard, "MOST_ROWS", 2):
            self.assertIn("the first 2 of 3 flows", self.draw(plot_benard))
        self.assertIn("benard_003.png", self.pictures())

    def test_a_run_that_failed_before_its_averages_shows_its_particles(self):
        row = particles(status="failed", kinetic_energy_field=NAN)
        self.particles(row, without=("fields", "grid"))
        self.assertEqual(self.draw(plot_benard), "")
        texts = self.texts("benard")
        self.assertTrue(any("at the particles" in text for text in texts), texts)
        self.assertNotIn("of the averaged flow", texts)

    def test_a_run_without_anything_is_named(self):
        self.particles(particles(), particles(5000, status="failed"))
        (self.folder / "point_002.h5").unlink()
        self.assertIn("point 2 (ideal gas, Ra = 5000) has no flow to draw (status failed)", self.draw(plot_benard))
        self.assertEqual(self.pictures(), ["benard.png"])

    def test_fluids_without_viscosity_are_named_by_their_coefficients(self):
        self.particles(particles() | {"rayleigh": math.inf, "viscosity": 0, "conductivity": 0.1})
        self.draw(plot_benard)
        self.assertFalse(any("Ra =" in text or "inf" in text for text in self.texts("benard")))

    def test_particles_at_rest_or_on_top_of_each_other_do_no_harm(self):
        self.particles(particles())
        with h5py.File(self.folder / "point_001.h5", "a") as file:
            file["last/position"][...] = file["last/position"][0]
            file["last/velocity_smoothed"][...] = 0
            for name in ("density", "temperature"):
                file[f"fields/{name}"][...] = 1.0
            file["fields/density"][0, 0] = NAN  # where no particle ever was
        self.assertEqual(self.draw(plot_benard), "")

    def test_the_same_results_give_the_same_picture(self):
        self.particles(particles())
        self.draw(plot_benard)
        first = [(self.folder / f"benard.{kind}").read_bytes() for kind in ("png", "svg")]
        self.draw(plot_benard)
        self.assertEqual([(self.folder / f"benard.{kind}").read_bytes() for kind in ("png", "svg")], first)

    def test_refusals(self):
        self.refused(plot_benard, "cannot read", "benard.csv")
        self.particles(particles())
        self.change("benard.csv", "gravity", "weight")
        self.refused(plot_benard, "no column gravity")
        self.particles(particles())
        self.change("benard.csv", "10000", "many")
        self.refused(plot_benard, 'rayleigh is "many"')
        self.particles(particles())
        (self.folder / "point_001.h5").write_bytes(b"nothing")
        self.refused(plot_benard, "cannot read", "point_001.h5")
        (self.folder / "point_001.h5").unlink()
        code, _, error = self.call(plot_benard)
        self.assertEqual(code, 2)
        self.assertIn("no point with a flow to draw", error)

    def test_a_python_without_libraries_gets_one_sentence(self):
        for library in ("numpy", "matplotlib", "h5py"):
            self.write(f"{library}.py", f"raise ImportError('{library} is not here')\n")
        for script in ("plot_benard.py", "plot_benard_compare.py"):
            process = subprocess.run([sys.executable, "-B", SCRIPTS / script, "x"], capture_output=True, text=True,
                                     env={**os.environ, "PYTHONPATH": str(self.folder)}, check=False)
            self.assertEqual(process.returncode, 1)
            self.assertIn(f"{script} needs numpy, matplotlib and h5py", process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1, process.stderr)


class BesideTheGrid(ConvectionTest):
    def compare(self, *folders, arguments=()):
        return self.draw(plot_benard_compare, *(self.folder / folder for folder in folders), *arguments)

    def test_contours_times_and_rayleigh_numbers_are_drawn(self):
        self.particles(particles(10000), particles(5000, 0.0031))
        self.grid(fluid(10000), fluid(5000, kinetic_energy=0.0034), fluid(2500, kinetic_energy=0.0015), end=1685.04)
        self.assertEqual(self.compare("grid"), "")
        self.assertEqual(self.pictures(), ["benard_compare.png", "benard_compare_fields_001.png",
                                           "benard_compare_fields_002.png", "benard_compare_time.png"])
        texts = self.texts("benard_compare")
        for text in ("continuum", "line to Ra = 1685", "published, continuum", "total", "smoothed",
                     "of the averaged flow", "ideal gas, periodic sides"):
            self.assertIn(text, texts)
        self.assertEqual(sum("published, " in text for text in texts), 2, texts)
        texts = self.texts("benard_compare_fields_001")
        self.assertIn("continuum, 8 cells over the height", texts)
        self.assertIn("ideal gas, Ra = 10000", texts)
        self.assertIn("continuum", self.texts("benard_compare_time"))

    def test_the_finest_mesh_is_shown_and_scaled_to_the_height_of_the_particles(self):
        self.particles(particles())
        self.grid(fluid(height=80), fluid(height=80, cells=10), fluid(height=80, cells=10, transport="kinematic"))
        self.assertEqual(self.compare("grid"), "")
        self.assertIn("continuum, 10 cells over the height", self.texts("benard_compare_fields_001"))
        row = particles()
        flow, _ = benard_flows.read_grid_point(self.folder / "grid" / "point_002.h5")
        self.assertEqual(plot_benard_compare.scaled(flow, 0.1)["x"][-1], row["width"] / 2)

    def test_fluids_and_cells_have_panels_of_their_own(self):
        self.particles(particles(), particles(equation_of_state="van-der-waals", gravity=0.25))
        self.particles(particles(20000, side="walls"), particles(10000, side="walls", kernel="monaghan"),
                       folder="square")
        self.grid(fluid(), fluid(20000, side="walls"))
        out = self.compare("square", "grid")
        self.assertIn("no flow on the grid beside van der Waals, Ra = 10000", out)
        self.assertIn("Monaghan's weight", out)
        texts = self.texts("benard_compare")
        for text in ("ideal gas, periodic sides", "van der Waals, periodic sides", "ideal gas, four walls"):
            self.assertIn(text, texts)
        self.assertTrue(any(text.startswith("total, ") and "Monaghan" in text for text in texts), texts)

    def test_without_a_grid_particles_stand_beside_print(self):
        self.particles(particles())
        self.assertIn("no flow on the grid beside ideal gas, Ra = 10000", self.compare())
        self.assertEqual(self.pictures(), ["benard_compare.png"])
        self.assertTrue(any("published, " in text and "5000" in text for text in self.texts("benard_compare")))

    def test_fluids_without_viscosity_have_no_place_on_the_axis(self):
        self.particles(particles() | {"rayleigh": math.inf, "viscosity": 0, "conductivity": 0.1})
        self.grid(fluid())
        self.assertIn("no kinetic energy at a Rayleigh number", self.compare("grid"))
        self.assertEqual(self.pictures(), [])

    def test_pictures_go_where_they_are_told_to(self):
        self.particles(particles())
        self.grid(fluid(), limits=False)
        (self.folder / "out").mkdir()
        self.compare("grid", arguments=("--out", self.folder / "out"))
        self.assertEqual(self.pictures(), [])
        self.assertEqual(len(self.pictures("out")), 3)

    def test_refusals(self):
        self.refused(plot_benard_compare, "holds neither a benard.csv nor a benard_grid.csv")
        self.grid(fluid(), folder=".")
        self.refused(plot_benard_compare, "none of the directories holds a benard.csv")
        self.particles(particles())
        self.refused(plot_benard_compare, "cannot read", "nowhere.csv", arguments=("--published", "nowhere.csv"))


if __name__ == "__main__":
    unittest.main()

# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy fields`: saved states as fields on a grid, from a tiny sweep with frames to HDF5, CSV and pictures."""

import csv
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from running import PROGRAM, SOURCE, TINY, ProgramTest

try:
    import h5py
    import numpy as np
except ImportError:
    h5py = None

RESULTS = [".lock", "fields.h5", "spectra.csv"]


def setUpModule():
    """One sweep for all tests: replica 1 of two rates, frames at times 15, 30, 45 and 60."""
    global SWEEP
    folder = tempfile.TemporaryDirectory(prefix="lucy_program_test_sweep_")
    unittest.addModuleCleanup(folder.cleanup)
    path = pathlib.Path(folder.name)
    (path / "numpy.py").write_text("raise ImportError('not in this test')\n")  # no pictures
    (path / "tiny.toml").write_text(TINY.replace("equilibration = 3", "equilibration = 15") +
                                    "[output]\nframe_interval = 15\nsample_interval = 0.5\n")
    subprocess.run([PROGRAM, "sweep", "tiny.toml", "--set", "system.particles=64", "--set", "run.duration=45", "--set",
                    "shear.strain_rate=[0.0,0.5]", "--out", "tiny"], cwd=path, check=True, capture_output=True,
                   env={**os.environ, "PYTHONPATH": str(path)})
    SWEEP = path / "tiny"


class FieldsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        for number in (1, 2):
            shutil.copy(SWEEP / f"point_00{number}.h5", self.folder)

    def fields(self, *arguments, code=0, says=(), **options):
        process = self.lucy("fields", *arguments, **options)
        self.expect(process, code, *says)
        return process

    def spectra(self, directory):
        rings = {}
        with open(self.folder / directory / "spectra.csv", newline="") as file:
            for row in csv.DictReader(file):
                ring = tuple(float(row[key]) for key in ("wave_number", "modes", "power"))
                rings.setdefault(row["field"], []).append(ring)
        return rings


class Answers(FieldsTest):
    def test_the_last_frame_beside_the_file(self):
        process = self.fields("point_001.h5")
        self.assertEqual(process.stderr, "")
        self.assertEqual(self.entries("point_001_fields"), RESULTS)
        self.assertIn("point_001.h5, replica 1, frame 4 of 4, time 60:", process.stdout)
        self.assertIn("64 atoms, Lucy's weight of range 3, 16 x 16 nodes.", process.stdout)
        for name in ("density", "velocity_smoothed x", "kinetic_temperature", "pressure_potential"):
            self.assertIn(f"\n{name} ", process.stdout)
        self.assertNotIn("peculiar", process.stdout)
        self.assertIn("of 64.\n", process.stdout)
        for line in process.stdout.splitlines():
            self.assertLessEqual(len(line), 120, line)

    def test_the_spectra_of_every_field(self):
        self.fields("point_001.h5", "--out", "rest")
        rings = self.spectra("rest")
        self.assertIn("velocity_smoothed_y", rings)
        self.assertIn("density", rings)
        self.assertAlmostEqual(rings["density"][0][0], 2 * math.pi / 8 * (1 + math.sqrt(2)) / 2, places=9)
        for name, spectrum in rings.items():
            self.assertEqual(sum(modes for _, modes, _ in spectrum), 16 * 16 - 1, name)
        self.fields("point_002.h5", "--out", "sheared")
        rings = self.spectra("sheared")
        self.assertIn("velocity_smoothed_peculiar_x", rings)
        self.assertNotIn("velocity_smoothed_x", rings)  # not periodic

    def test_frames_by_number_and_by_time(self):
        for choice, words in {("--frame", "1"): "frame 1 of 4, time 15:", ("--time", "31"): "frame 2 of 4, time 30:",
                              ("--time", "60"): "frame 4 of 4", ("--average",): "average over 4 frames",
                              ("--frame", "all"): "average over 4 frames, time 15 to 60:"}.items():
            self.assertIn(words, self.fields("point_001.h5", *choice, "--out", "it").stdout)

    def test_another_grid_and_another_weight(self):
        process = self.fields("point_001.h5", "--grid", "20", "24", "--kernel", "monaghan", "--range", "2.5")
        self.assertIn("Monaghan's weight of range 2.5, 20 x 24 nodes", process.stdout)

    def test_the_same_state_gives_the_same_files(self):
        self.fields("point_002.h5", "--out", "it")
        before = self.contents("it", ["fields.h5", "spectra.csv"])
        self.fields("point_002.h5", "--out", "it")
        self.assertEqual(self.contents("it", ["fields.h5", "spectra.csv"]), before)

    def test_help_and_command_list(self):
        process = self.lucy("fields", "--help")
        self.assertEqual(process.returncode, 0)
        for option in ("--frame", "--time", "--average", "--grid", "--kernel", "--range", "--replica", "--no-pictures"):
            self.assertIn(option, process.stdout)
        self.assertIn("lucy fields", self.lucy().stderr)


@unittest.skipIf(h5py is None, "no h5py")
class Contents(FieldsTest):
    def values(self, directory, *names):
        with h5py.File(self.folder / directory / "fields.h5") as file:
            return [file[name][...] for name in names]

    def test_everything_has_a_unit_and_a_meaning(self):
        self.fields("point_002.h5", "--out", "it")
        with h5py.File(self.folder / "it" / "fields.h5") as file:
            datasets = []
            file.visititems(lambda name, item: datasets.append(item) if isinstance(item, h5py.Dataset) else None)
            self.assertGreater(len(datasets), 30)
            for dataset in datasets:
                self.assertTrue(dataset.attrs["unit"], dataset.name)
                self.assertTrue(dataset.attrs["meaning"], dataset.name)
            provenance = file["provenance"].attrs
            self.assertEqual(provenance["source"], b"point_002.h5")
            self.assertEqual((provenance["frame"], provenance["frames"], provenance["time"]), (4, 1, 60.0))
            self.assertTrue(provenance["command"].decode().endswith("fields point_002.h5 --out it"))
            self.assertEqual(file["parameters"].attrs["medium"], b"atoms")
            self.assertEqual(file["parameters"].attrs["strain_rate"], 0.5)

    def test_fields_are_sums_over_particles(self):
        """Brute force in numpy, over all images, with their laboratory velocities."""
        self.fields("point_002.h5", "--out", "it", "--grid", "6", "5")
        with h5py.File(self.folder / "point_002.h5") as file:
            group = file["particles/replica_01"]
            position, velocity = group["position/value"][-1], group["velocity/value"][-1]
            offset = group["lees_edwards/offset/value"][-1, 0]
        x, y, density, smoothed, at_particles, of_particles, individual = self.values(
            "it", "grid/x", "grid/y", "fields/density", "fields/velocity_smoothed", "particles/velocity_smoothed",
            "particles/density", "particles/velocity_individual")
        np.testing.assert_array_equal(individual, velocity)
        np.testing.assert_allclose(x, np.arange(6) * 8 / 6)
        np.testing.assert_allclose(y, np.arange(5) * 8 / 5)
        nodes = np.stack(np.meshgrid(x, y), axis=-1)
        for places, rho, u in ((nodes, density, smoothed), (position, of_particles, at_particles)):
            mass, momentum = np.zeros(places.shape[:-1]), np.zeros(places.shape)
            for up in (-1, 0, 1):
                for along in range(-2, 3):
                    image = position + [along * 8 + up * offset, up * 8]
                    s = np.linalg.norm(places[..., None, :] - image, axis=-1) / 3
                    w = np.where(s < 1, 5 / (9 * np.pi) * (1 + 3 * s) * (1 - s) ** 3, 0)
                    mass += w.sum(axis=-1)
                    momentum += w @ (velocity + [up * 0.5 * 8, 0])
            np.testing.assert_allclose(rho, mass, rtol=1e-12)
            np.testing.assert_allclose(u, momentum / mass[..., None], atol=1e-11)

    def test_the_spectra_are_those_of_the_fields(self):
        self.fields("point_001.h5", "--out", "it")
        density, = self.values("it", "fields/density")
        transform = np.abs(np.fft.fft2(density) / density.size) ** 2
        rings = self.spectra("it")["density"]
        number = np.fft.fftfreq(16) * 16
        a, b = np.meshgrid(number, number)
        ring = np.floor(np.hypot(a, b) + 0.5)
        for index in (1, 2, 5, 8):
            wave_number, modes, power = rings[index - 1]
            self.assertEqual(modes, np.sum(ring == index))
            self.assertAlmostEqual(power, transform[ring == index].mean(), delta=1e-12)
        with h5py.File(self.folder / "it" / "fields.h5") as file:
            self.assertAlmostEqual(file["spectra/density"].attrs["variance"], density.var(), delta=1e-14)
            self.assertAlmostEqual(file["spectra"].attrs["whole_up_to"], np.pi * 16 / 8, delta=1e-12)

    def test_an_average_is_one_of_densities(self):
        names = ("fields/density", "fields/velocity_smoothed", "fields/kinetic_energy_density_individual")
        density, momentum, energy = 0, 0, 0
        for frame in range(1, 5):
            self.fields("point_001.h5", "--frame", frame, "--out", "it")
            rho, u, k = self.values("it", *names)
            density, momentum, energy = density + rho / 4, momentum + rho[..., None] * u / 4, energy + k / 4
        self.fields("point_001.h5", "--average", "--out", "it")
        rho, u, k = self.values("it", *names)
        np.testing.assert_allclose(rho, density, rtol=1e-12)
        np.testing.assert_allclose(u, momentum / density[..., None], atol=1e-12)
        np.testing.assert_allclose(k, energy, rtol=1e-12)
        with h5py.File(self.folder / "it" / "fields.h5") as file:
            self.assertNotIn("particles", file)
            self.assertEqual(file["provenance"].attrs["frames"], 4)

    def test_a_fluid_has_the_pressure_of_its_equation_of_state(self):
        energy = np.random.default_rng(3).uniform(0.5, 1.5, (4, 64))
        with h5py.File(self.folder / "point_001.h5", "a") as file:
            file["parameters"].attrs["equation_of_state"] = np.bytes_("van-der-waals")
            file["particles/replica_01/internal_energy/value"] = energy
        process = self.fields("point_001.h5", "--out", "it")
        self.assertIn("64 smooth particles, van-der-waals,", process.stdout)
        rho, e, temperature, pressure, own = self.values("it", "fields/density", "fields/internal_energy",
                                                         "fields/temperature", "fields/pressure",
                                                         "particles/internal_energy")
        np.testing.assert_array_equal(own, energy[-1])
        np.testing.assert_allclose(temperature, e + rho / 2, rtol=1e-12)
        np.testing.assert_allclose(pressure, rho * temperature / (1 - rho / 2) - rho**2 / 2, rtol=1e-11)
        with h5py.File(self.folder / "it" / "fields.h5") as file:
            self.assertNotIn("pressure_potential", file["fields"])
        with h5py.File(self.folder / "point_001.h5", "a") as file:
            file["parameters"].attrs["equation_of_state"] = np.bytes_("treacle")
        self.fields("point_001.h5", "--out", "it", code=2, says=["treacle", "van-der-waals"])


class Refusals(FieldsTest):
    def test_files_that_are_no_saved_states(self):
        self.write("text.h5", "no numbers")
        for file, says in {"missing.h5": "no such file", "text.h5": "not an HDF5 file", ".": "directory"}.items():
            self.fields(file, code=2, says=[says])
        self.fields(code=2, says=["FILE"])

    def test_a_file_without_frames(self):
        self.sweep("tiny.toml", "--set", "run.duration=3", "--out", "bare")
        self.fields("bare/point_001.h5", code=2, says=["bare/point_001.h5", "output.frame_interval"])

    def test_frames_and_replicas_that_are_not_there(self):
        here = "frames 1 to 4 of replica 1, from time 15 to 60"
        for arguments, says in {("--frame", "5"): here, ("--frame", "0"): here, ("--frame", "-1"): here,
                                ("--frame", "last"): "'all'", ("--time", "60.1"): here, ("--time", "14.9"): here,
                                ("--time", "nan"): here, ("--replica", "2"): "(frames of: replica_01)",
                                ("--replica", "0"): "from 1", ("--frame", "1", "--time", "3"): "--time",
                                ("--average", "--frame", "2"): "--average",
                                ("--average", "--time", "2"): "--average"}.items():
            self.fields("point_001.h5", *arguments, code=2, says=[says])
        self.assertEqual(self.entries(), ["point_001.h5", "point_002.h5", "tiny.toml"])

    def test_grids_and_weights_that_make_no_sense(self):
        for arguments, says in {("--grid", "1", "8"): "1 x 8", ("--grid", "100000", "100000"): "at most",
                                ("--grid", "8"): "--grid", ("--range", "0"): "--range is 0",
                                ("--range", "inf"): "--range", ("--range", "9"): "longer than the box",
                                ("--kernel", "gauss"): "monaghan"}.items():
            self.fields("point_001.h5", *arguments, code=2, says=[says])
        self.assertEqual(self.entries(), ["point_001.h5", "point_002.h5", "tiny.toml"])

    def test_directories_that_hold_something_else(self):
        (self.folder / "mine").mkdir()
        self.write("mine/thesis.tex", "all of it")
        self.fields("point_001.h5", "--out", "mine", code=2, says=["thesis.tex", "--out"])
        self.assertEqual(self.entries("mine"), ["thesis.tex"])
        self.fields("point_001.h5", "--out", "tiny.toml", code=2, says=["is a file", "--out"])
        self.fields("point_001.h5", "--out", "", code=2, says=["--out"])
        self.fields("point_001.h5", "--out", "it")
        self.write("it/notes.md", "my own")
        self.fields("point_001.h5", "--out", "it", code=2, says=["notes.md"])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_directory_that_may_not_be_written(self):
        (self.folder / "it").mkdir(mode=0o500)
        self.fields("point_001.h5", "--out", "it", code=2, says=["Permission denied"])


class Pictures(FieldsTest):
    def test_are_drawn_of_atoms_and_replaced(self):
        environment = self.environment(pictures=True)
        check = subprocess.run(["/usr/bin/python3", "-c", "import numpy, matplotlib, h5py"], capture_output=True)
        if check.returncode != 0:
            self.skipTest("no matplotlib")
        self.fields("point_002.h5", "--out", "it", environment=environment)
        script = ["/usr/bin/python3", "-B", SOURCE / "analysis" / "plot_fields.py"]
        refused = subprocess.run([*script, self.folder], capture_output=True, text=True, env=environment)
        self.assertEqual(refused.returncode, 2)
        self.assertRegex(refused.stderr, r"^plot_fields.py: cannot read .*fields.h5 as fields of Lucy: [^\n]*\n$")
        pictures = ["fields.png", "fields.svg", "spectra.png", "spectra.svg"]
        self.assertEqual(self.entries("it"), sorted(RESULTS + pictures))
        before = self.contents("it", ["fields.svg", "spectra.svg"])
        self.assertIn(b"smoothed velocity, peculiar", before["fields.svg"])
        self.fields("point_002.h5", "--out", "it", environment=environment)
        self.assertEqual(self.contents("it", ["fields.svg", "spectra.svg"]), before)
        self.fields("point_001.h5", "--out", "it", "--no-pictures", environment=environment)
        self.assertEqual(self.entries("it"), RESULTS)

    def test_without_matplotlib_the_command_is_told(self):
        self.assertIn("plot_fields.py it", self.fields("point_001.h5", "--out", "it").stdout)


if __name__ == "__main__":
    unittest.main()

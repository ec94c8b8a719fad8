# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy read-dump`: frames of a sheared run in the formats of other programs, read again by ASE, which shares no code
with Lucy, and by Lucy."""

import sys
import unittest

from running import TINY, ProgramTest

try:
    import ase.io
    import h5py
    import numpy as np
except ImportError:
    ase = None

RATE = 0.5


class ReadDumpTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("frames.toml", TINY.replace("strain_rate = [0.5, 1]", f"strain_rate = {RATE}").replace(
            "replicas = 2", "replicas = 1") + "[output]\nframe_interval = 7.3\nsample_interval = 0.1\n")
        self.sweep("frames.toml", "--set", "run.duration=73", "--out", "x")
        with h5py.File(self.folder / "x/point_001.h5", "r") as file:
            group = file["particles/replica_01"]
            self.positions = group["position/value"][:]
            self.velocities = group["velocity/value"][:]
            self.momenta = group["momentum/value"][:]
            self.edges = group["box/edges/value"][:]
            self.times = group["position/time"][:]

    def read_dump(self, *arguments, code=0, says=()):
        process = self.lucy("read-dump", *arguments)
        self.expect(process, code, *says)
        return process

    def distances(self, positions, cell):
        """Of all pairs, nearest images by brute force."""
        separation = positions[:, None, :2] - positions[None, :, :2]
        images = [i * cell[0] + j * cell[1] for i in (-2, -1, 0, 1, 2) for j in (-1, 0, 1)]
        return np.min([np.hypot(*np.moveaxis(separation + image, -1, 0)) for image in images], axis=0)

    def expect_same_frames(self, frames):
        self.assertEqual(len(frames), len(self.times))
        tilts = set()
        for frame, positions, edges in zip(frames, self.positions, self.edges):
            cell = frame.cell[:2, :2]
            tilts.add(round(cell[1, 0], 6))
            # The tilt is the offset but for a whole box, and every pair is as far apart as it was.
            self.assertAlmostEqual((cell[1, 0] - edges[1, 0]) / cell[0, 0] % 1, 0, delta=1e-9)
            np.testing.assert_allclose([cell[0, 0], cell[1, 1]], [edges[0, 0], edges[1, 1]], atol=1e-9)
            np.testing.assert_allclose(self.distances(frame.positions, cell), self.distances(positions, edges),
                                       atol=1e-9)
        self.assertGreater(len(tilts), 3)
        self.assertTrue(min(tilts) < 0 < max(tilts))


class Answers(ReadDumpTest):
    def test_ase_reads_the_dump_with_the_cell_right_in_every_frame(self):
        self.read_dump("x/point_001.h5", "--out", "x.dump")
        frames = ase.io.read(self.folder / "x.dump", ":", format="lammps-dump-text")
        self.expect_same_frames(frames)
        # ASE takes velocities for Angstrom per femtosecond of its own units; one ratio for all of them.
        ratio = frames[-1].get_velocities()[:, :2] / self.velocities[-1]
        np.testing.assert_allclose(ratio, ratio[0, 0], rtol=1e-7)

    def test_ase_reads_extended_xyz_with_the_cell_right_in_every_frame(self):
        self.read_dump("x/point_001.h5", "--out", "x.xyz")
        frames = ase.io.read(self.folder / "x.xyz", ":", format="extxyz")
        self.expect_same_frames(frames)
        for frame, velocities, time in zip(frames, self.velocities, self.times):
            np.testing.assert_allclose(frame.arrays["velo"][:, :2], velocities, atol=1e-9)
            self.assertAlmostEqual(frame.info["Time"], time)
            self.assertEqual(frame.info["strain_rate"], RATE)
            self.assertEqual(list(frame.pbc), [True, True, False])

    def test_ase_reads_the_data_file(self):
        self.read_dump("x/point_001.h5", "--frame", "3", "--out", "x.data")
        frame = ase.io.read(self.folder / "x.data", format="lammps-data", style="atomic", sort_by_id=True)
        np.testing.assert_allclose(self.distances(frame.positions, frame.cell[:2, :2]),
                                   self.distances(self.positions[2], self.edges[2]), atol=1e-9)

    def test_formats_are_converted_into_each_other_without_loss(self):
        self.read_dump("x/point_001.h5", "--out", "a.xyz")
        said = self.read_dump("a.xyz", "--out", "b.dump").stdout
        self.assertIn("Written: b.dump, LAMMPS dump, 11 frames", said)
        self.assertIn("There already", self.read_dump("a.xyz", "--out", "b.dump").stdout)
        self.read_dump("b.dump", "--strain-rate", RATE, "--out", "c.xyz")
        a, c = (ase.io.read(self.folder / name, ":", format="extxyz") for name in ("a.xyz", "c.xyz"))
        for before, after in zip(a, c):
            np.testing.assert_allclose(after.positions, before.positions, atol=1e-12)
            np.testing.assert_allclose(after.arrays["velo"], before.arrays["velo"], atol=1e-12)

    def test_a_sweep_goes_on_from_any_format_as_from_the_point_file(self):
        self.read_dump("x/point_001.h5", "--out", "s.data")
        self.read_dump("x/point_001.h5", "--out", "s.dump", "--peculiar")
        rows = []
        for name in ("x/point_001.h5", "s.data", "s.dump"):
            out = "from_" + name.replace("/", "_")
            self.sweep("frames.toml", "--set", f'system.start="{name}"', "--set", "run.equilibration=0", "--set",
                       "run.duration=3", "--set", "output.frame_interval=0", "--out", out)
            rows.append(self.rows(out)[0])
        for row in rows[1:]:
            for column in ("pxy_kinetic", "potential_energy", "largest_kinetic_share"):
                self.assertAlmostEqual(float(row[column]), float(rows[0][column]), delta=1e-8, msg=column)

    def test_reads_a_dump_that_is_still_being_written(self):
        self.read_dump("x/point_001.h5", "--out", "x.dump")
        text = (self.folder / "x.dump").read_text()
        self.write("cut.dump", text[:-3])
        said = self.read_dump("cut.dump", "--frame", "2", "--out", "second.data").stdout
        self.assertIn("10 frames of 36 particles, and one that is not finished", said)
        self.read_dump("x.dump", "--frame", "2", "--out", "whole.data")
        self.assertEqual((self.folder / "second.data").read_text().splitlines()[1:],
                         (self.folder / "whole.data").read_text().splitlines()[1:])
        self.read_dump("cut.dump", "--frame", "11", code=2, says=("frame 11 is not finished", "ends within line"))
        self.read_dump("cut.dump", "--frame", "12", code=2, says=("--frame is 12", "frames 1 to 10"))

    def test_a_data_file_takes_the_last_frame_and_says_so(self):
        said = self.read_dump("x/point_001.h5", "--out", "x.data").stdout
        self.assertIn("the last frame (a data file holds one)", said)

    def test_says_what_is_in_a_file(self):
        said = self.read_dump("x/point_001.h5").stdout
        for piece in ("11 frames of 36 particles", "tilt", "kT = ", "density 1"):
            self.assertIn(piece, said)


class Refusals(ReadDumpTest):
    def test_bad_requests_end_with_two_and_a_sentence(self):
        self.read_dump("x/point_001.h5", "--frame", "12", code=2, says=("frames 1 to 11",))
        self.read_dump("x/point_001.h5", "--out", "a.txt", code=2, says=("a.txt", ".data"))
        self.read_dump("nowhere.dump", code=2, says=("nowhere.dump",))
        self.read_dump("frames.toml", code=2, says=("frames.toml", "none of these"))
        self.read_dump("x", code=2, says=("x",))
        self.read_dump("x/point_001.h5", "--strain-rate", "0.1", code=2, says=("--strain-rate",))

    def test_nothing_is_written_over(self):
        self.read_dump("x/point_001.h5", "--out", "x.xyz")
        before = (self.folder / "x.xyz").read_bytes()
        (self.folder / "link.xyz").symlink_to("x.xyz")
        for name in ("x.xyz", "./x.xyz", "link.xyz"):
            self.read_dump("x.xyz", "--peculiar", "--out", name, code=2, says=(name, "the file that is read"))
        self.write("thesis.xyz", "chapter one\n")
        self.read_dump("x/point_001.h5", "--out", "thesis.xyz", code=2, says=("thesis.xyz", "something else"))
        self.assertEqual((self.folder / "thesis.xyz").read_text(), "chapter one\n")
        self.assertEqual((self.folder / "x.xyz").read_bytes(), before)

    def test_a_run_does_not_go_on_with_another_start(self):
        self.read_dump("x/point_001.h5", "--frame", "11", "--out", "s.data")
        sweep = ("frames.toml", "--set", 'system.start="s.data"', "--set", "output.frame_interval=0", "--out", "y")
        self.sweep(*sweep)
        (self.folder / "s.data").unlink()
        self.read_dump("x/point_001.h5", "--frame", "10", "--out", "s.data")
        self.sweep(*sweep, code=2, says=("another input", "start_checksum"))

    def test_the_momenta_of_a_point_file_have_no_flow_to_be_taken_out(self):
        self.sweep("frames.toml", "--set", 'system.start="x/point_001.h5"', "--set", "system.start_strain_rate=0.5",
                   "--out", "y", code=2, says=("system.start_strain_rate", "peculiar"))

    def test_a_start_of_another_system_is_refused(self):
        for setting, says in (("system.particles=64", "has 36 particles"), ("system.density=0.8", "system.density"),
                              ("run.replicas=2", "run.replicas"), ("system.energy_per_particle=2", "has 1"),
                              ('system.start="nowhere"', "nowhere")):
            with self.subTest(setting):
                self.sweep("frames.toml", "--set", 'system.start="x/point_001.h5"', "--set", setting, "--out", "y",
                           code=2, says=(says,))


if __name__ == "__main__":
    if ase is None:
        print("skipped: no ASE, h5py or numpy")
        sys.exit(77)
    unittest.main(verbosity=2)

# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sweep that is interrupted ends with the same bits: killed again and again, stopped by signals, with a damaged
checkpoint, on a full disk, and by another build."""

import json
import os
import random
import resource
import shutil
import signal
import subprocess
import time
import unittest

from running import ProgramTest

try:
    import h5py
except ImportError:
    h5py = None

# A second or two of work on two cores: frames, several replicas, and a target that one point reaches before the other.
LONGER = """\
[system]
particles = 100
energy_per_particle = 1
[shear]
strain_rate = [0.3, 1]
[run]
equilibration = 20
duration = 300
maximum_duration = 1200
target_relative_error = 0.0115
replicas = 2
threads = 2
checkpoint_interval = 0.05
[output]
frame_interval = 50
"""

SERIES = ("table.csv", "replicas.csv", "notes.txt", "input.toml", "point_001.h5", "point_002.h5")


def crc64(text):
    """CRC-64/XZ, as in files/checkpoint.hpp."""
    remainder = 0xFFFFFFFFFFFFFFFF
    for byte in text:
        remainder ^= byte
        for _ in range(8):
            remainder = remainder >> 1 ^ (0xC96C5795D7870F42 if remainder & 1 else 0)
    return remainder ^ 0xFFFFFFFFFFFFFFFF


class Resume(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("longer.toml", LONGER)

    def uninterrupted(self):
        begin = time.monotonic()
        self.sweep("longer.toml", "--out", "whole")
        self.seconds_of_the_whole = time.monotonic() - begin
        return self.contents("whole", SERIES)

    def checkpoint_times(self, directory="x"):
        times = {}
        for path in (self.folder / directory / "checkpoints").glob("point_*"):
            try:
                times[path.name] = path.stat().st_mtime_ns
            except FileNotFoundError:
                pass
        return times

    def start_and_wait_for_checkpoint(self, *arguments):
        """A sweep that has written a new checkpoint, or ended."""
        before = self.checkpoint_times()
        process = self.start("sweep", "longer.toml", "--out", "x", *arguments)
        while process.poll() is None and self.checkpoint_times() == before:
            time.sleep(0.002)
        return process

    def a_while(self):
        """Short against the whole, so that a fast machine is interrupted as often as a slow one."""
        return 0.05 * self.seconds_of_the_whole

    @staticmethod
    def kill(process):
        process.kill()
        process.wait()
        process.stderr.close()

    def kill_after_a_checkpoint(self, seconds=0.0):
        process = self.start_and_wait_for_checkpoint()
        time.sleep(seconds)
        self.kill(process)
        return process

    def test_killed_at_any_moment_it_ends_with_the_same_bits(self):
        expected = self.uninterrupted()
        moments = random.Random(20)
        kills = 0
        longest_wait = self.a_while()
        for attempt in range(60):
            if attempt % 3 == 2:  # at any moment, before the first checkpoint too
                process = self.start("sweep", "longer.toml", "--out", "x")
                time.sleep(moments.uniform(0.0, longest_wait))
            else:
                process = self.start_and_wait_for_checkpoint()
                time.sleep(moments.uniform(0.0, longest_wait))
            process.kill()
            process.wait()
            complaints = process.stderr.read()
            process.stderr.close()
            self.assertNotIn("cannot be used", complaints)
            if process.returncode == 0:
                break
            kills += 1
        last = self.sweep("longer.toml", "--out", "x")
        self.assertGreaterEqual(kills, 3)
        self.assertEqual(self.contents("x", SERIES), expected, last.stderr)
        self.assertNotIn("checkpoints", self.entries("x"))
        if h5py:
            with h5py.File(self.folder / "x" / "point_001.h5") as file:
                self.assertGreater(file["observables/replica_01/pxy_kinetic/value"].shape[0], 200)

    def test_killed_at_the_end_it_leaves_nothing_half_done(self):
        """As if killed after each of the last steps: before table.csv all is there to go on from, after it to print."""
        expected = self.uninterrupted()
        self.kill_after_a_checkpoint()
        x = self.folder / "x"
        checkpoints = x / "checkpoints"
        saved = {path.name: path.read_bytes() for path in checkpoints.iterdir()}
        self.sweep("longer.toml", "--out", "x")
        # table.csv is there, checkpoints/ is not yet removed.
        checkpoints.mkdir()
        for name, contents in saved.items():
            (checkpoints / name).write_bytes(contents)
        again = self.sweep("longer.toml", "--out", "x")
        self.assertIn("nothing was run", again.stdout)
        self.assertFalse(checkpoints.exists())
        # All but table.csv is there; what is there is from the end, the checkpoints are older.
        (x / "table.csv").unlink()
        checkpoints.mkdir()
        for name, contents in saved.items():
            (checkpoints / name).write_bytes(contents)
        (x / ".table.csv.tmp").write_text("half a ta")
        self.sweep("longer.toml", "--out", "x")
        self.assertEqual(self.contents("x", SERIES), expected)

    def test_other_threads_go_on_with_the_same_bits(self):
        expected = self.uninterrupted()
        for threads in (2, 1, 3):
            process = self.start_and_wait_for_checkpoint("--set", f"run.threads={threads}")
            process.send_signal(signal.SIGTERM)
            process.wait()
            process.stderr.close()
        self.sweep("longer.toml", "--out", "x", "--set", "run.threads=1")
        self.assertEqual(self.contents("x", SERIES), expected)

    def test_signals_are_answered_with_a_checkpoint(self):
        expected = self.uninterrupted()
        for kind in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            # No checkpoint but the one that the signal asks for. It listens before it writes or says anything.
            resumes = self.checkpoint_times() != {}
            process = self.start("sweep", "longer.toml", "--out", "x", "--set", "run.checkpoint_interval=1000")
            if resumes:
                self.assertIn("resuming", process.stderr.readline())
            while process.poll() is None and not (self.folder / "x" / "checkpoints" / "build.txt").exists():
                time.sleep(0.002)
            time.sleep(self.a_while())
            before = self.checkpoint_times()
            process.send_signal(kind)
            self.assertEqual(process.wait(timeout=60), 1)
            self.assertIn("interrupted; the same command resumes", process.stderr.read())
            process.stderr.close()
            self.assertNotEqual(self.checkpoint_times(), before)
            self.assertNotIn("table.csv", self.entries("x"))
        process = self.sweep("longer.toml", "--out", "x")
        self.assertIn("resuming", process.stderr)
        self.assertEqual(self.contents("x", SERIES), expected)
        record = json.loads((self.folder / "x" / "provenance.json").read_text())
        self.assertTrue(record["resumed"])
        self.assertIn("of all sessions", record["wall_seconds_note"])

    def test_a_damaged_checkpoint_is_told_of_and_the_one_before_taken(self):
        expected = self.uninterrupted()

        def newest_with_an_older_one():
            times = self.checkpoint_times()
            for name in sorted(times):
                other = name[:-1] + ("b" if name.endswith("a") else "a")
                if other in times and times[other] < times[name]:
                    return self.folder / "x" / "checkpoints" / name
            return None

        def flip(path):
            contents = bytearray(path.read_bytes())
            contents[-100] ^= 1
            path.write_bytes(contents)

        def cut(path):
            os.truncate(path, path.stat().st_size // 2)

        for damage in (flip, cut):
            shutil.rmtree(self.folder / "x", ignore_errors=True)
            process = self.start("sweep", "longer.toml", "--out", "x", "--set", "run.checkpoint_interval=0.01")
            while process.poll() is None and not newest_with_an_older_one():
                time.sleep(0.002)
            self.kill(process)
            victim = newest_with_an_older_one()
            self.assertIsNotNone(victim)
            damage(victim)
            process = self.sweep("longer.toml", "--out", "x")
            self.assertRegex(process.stderr, f"{victim.name} cannot be used.*the one before it is taken")
            self.assertEqual(self.contents("x", SERIES), expected)

    def test_when_both_are_damaged_the_replica_begins_again(self):
        expected = self.uninterrupted()
        self.kill_after_a_checkpoint()
        for name in self.checkpoint_times():
            (self.folder / "x" / "checkpoints" / name).write_bytes(b"nonsense")
        process = self.sweep("longer.toml", "--out", "x")
        self.assertIn("this replica begins again", process.stderr)
        self.assertEqual(self.contents("x", SERIES), expected)

    def test_frames_that_are_gone_make_the_replica_begin_again(self):
        expected = self.uninterrupted()
        frames = self.folder / "x" / "checkpoints" / "frames_002_01.bin"
        while not (frames.exists() and frames.stat().st_size > 0):
            process = self.start_and_wait_for_checkpoint()
            time.sleep(self.a_while())
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(), 1)
            process.stderr.close()
        frames.unlink()
        process = self.sweep("longer.toml", "--out", "x")
        self.assertIn("begins again", process.stderr)
        self.assertEqual(self.contents("x", SERIES), expected)

    def test_damaged_frames_make_the_replica_begin_again(self):
        expected = self.uninterrupted()
        frames = self.folder / "x" / "checkpoints" / "frames_002_01.bin"
        while not (frames.exists() and frames.stat().st_size > 0):
            process = self.start_and_wait_for_checkpoint()
            time.sleep(self.a_while())
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(), 1)
            process.stderr.close()
        with open(frames, "r+b") as file:
            file.seek(200)
            file.write(b"garbage!")
        process = self.sweep("longer.toml", "--out", "x")
        self.assertRegex(process.stderr, "rate 1: replica 1 begins again.*frames_002_01.bin is damaged")
        self.assertEqual(self.contents("x", SERIES), expected)

    def test_a_damaged_record_of_the_build_costs_nothing(self):
        expected = self.uninterrupted()
        record = self.folder / "x" / "checkpoints" / "build.txt"
        sound = None
        for damage in (lambda text: os.urandom(300), lambda text: text[:40], lambda text: text[:-1], lambda text: b"",
                       lambda text: text.replace(b"Lucy", b"Lusy"), None):
            process = self.kill_after_a_checkpoint()
            if process.returncode == 0:
                self.skipTest("too fast a machine")
            sound = sound or record.read_bytes()
            self.assertEqual(record.read_bytes(), sound)
            if damage:
                record.write_bytes(damage(sound))
            else:
                record.unlink()
            process = self.start("sweep", "longer.toml", "--out", "x")
            if damage:
                complaint = process.stderr.readline()
                self.assertIn("build.txt is damaged", complaint)
                self.assertTrue(complaint.rstrip("\n").isprintable(), complaint)
            self.assertIn("resuming", process.stderr.readline())
            self.kill(process)
        self.sweep("longer.toml", "--out", "x")
        self.assertEqual(self.contents("x", SERIES), expected)

    def test_checkpoints_of_another_build_are_not_taken_up(self):
        expected = self.uninterrupted()
        self.kill_after_a_checkpoint()
        record = self.folder / "x" / "checkpoints" / "build.txt"
        other = record.read_text().split("\n")[0].replace("commit ", "commit 0")
        record.write_text(f"{other}\nCRC-64 {crc64(other.encode()):016x}\n")
        process = self.sweep("longer.toml", "--out", "x")
        self.assertIn("another build of Lucy", process.stderr)
        self.assertNotIn("resuming", process.stderr)
        self.assertEqual(self.contents("x", SERIES), expected)


class FullDisk(ProgramTest):
    # The first point is done early; the states of the second outgrow the disk.
    TWO = ("[system]\nparticles = 36\nenergy_per_particle = 1\n[run]\nequilibration = 0\nreplicas = 1\nthreads = 1\n"
           "checkpoint_interval = 0.05\n[output]\nsample_interval = 0.05\n"
           "[[point]]\nparticles = 400\nstrain_rate = 0.5\nduration = 20\n"
           "[[point]]\nstrain_rate = 1\nduration = 200\n")

    def check_and_resume(self, process, directory):
        self.assertEqual(process.returncode, 1, process.stderr)
        lines = process.stderr.rstrip("\n").split("\n")
        self.assertEqual(len(lines), 2, process.stderr)
        self.assertRegex(lines[0], "^lucy: cannot write .*point_002.*: (File too large|No space left on device)")
        self.assertIn("the same command resumes", lines[1])
        self.assertIn("point_001.h5", self.entries(directory))
        self.assertNotIn("table.csv", self.entries(directory))
        finished = self.contents(directory, ("point_001.h5", "input.toml"))
        return finished

    def test_a_file_that_may_not_grow_ends_the_sweep_clearly(self):
        self.write("two.toml", self.TWO)
        self.sweep("two.toml", "--out", "whole")
        limit = 110_000
        process = self.lucy("sweep", "two.toml", "--out", "x",
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        finished = self.check_and_resume(process, "x")
        self.sweep("two.toml", "--out", "x")
        self.assertEqual(self.contents("x"), self.contents("whole"))
        self.assertEqual(self.contents("x", tuple(finished)), finished)

    def test_a_full_file_system_ends_the_sweep_clearly(self):
        self.write("two.toml", self.TWO)
        self.sweep("two.toml", "--out", "whole")
        disk = self.folder / "disk"
        disk.mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", str(disk)]
        if subprocess.run(mount, capture_output=True).returncode != 0:
            self.skipTest("nothing can be mounted here")
        try:
            process = self.lucy("sweep", "two.toml", "--out", "disk/x")
            finished = self.check_and_resume(process, "disk/x")
            subprocess.run(["mount", "-o", "remount,size=40m", str(disk)], check=True)
            self.sweep("two.toml", "--out", "disk/x")
            self.assertEqual(self.contents("disk/x"), self.contents("whole"))
            self.assertEqual(self.contents("disk/x", tuple(finished)), finished)
        finally:
            subprocess.run(["umount", str(disk)], check=True)


if __name__ == "__main__":
    unittest.main()

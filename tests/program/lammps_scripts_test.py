# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts of an exported case in the real LAMMPS: pairs that overlap, neighbour lists of fast particles, runs that
are cut off and go on. Where it is not installed: skipped: no LAMMPS."""

import math
import re
import subprocess
import time

from running import ProgramTest, main_with_lammps

SMALL = """\
[system]
particles = 144
energy_per_particle = 1
kinetic_temperature = 0.54
[shear]
strain_rate = [0.0, 0.5]
[run]
equilibration = 10
duration = 240
"""
FREE, SHEARED = ("point_001", "nve"), ("point_002", "sheared")
STEPS = 5000


class ScriptTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("small.toml", SMALL)
        self.expect(self.lucy("lammps", "export", "small.toml", "--out", "x"), 0)

    def command(self, script, variables):
        return ["lmp", "-in", f"{script}.in", "-log", f"{script}.log", "-screen", "none",
                *(word for name, value in variables.items() for word in ("-var", name, str(value)))]

    def run_script(self, folder, script, **variables):
        process = subprocess.run(self.command(script, variables), cwd=self.folder / "x" / folder, capture_output=True,
                                 text=True, timeout=300)
        log = (self.folder / "x" / folder / f"{script}.log").read_text()
        self.assertEqual(process.returncode, 0, log[-2000:])
        return log

    def series(self, folder, script):
        """Rows by step, of those of one step the last."""
        lines = (self.folder / "x" / folder / f"{script}_series.dat").read_text().splitlines()
        names = lines[1].lstrip("# ").split()
        rows = (dict(zip(names, map(float, line.split()))) for line in lines if not line.startswith("#"))
        return {int(row["step"]): row for row in rows}

    def change_start(self, folder, pattern, change):
        path = self.folder / "x" / folder / "start.data"
        text = path.read_text()
        changed = re.sub(pattern, change, text, flags=re.MULTILINE)
        self.assertNotEqual(changed, text)
        path.write_text(changed)


class Scripts(ScriptTest):
    def test_a_pair_that_overlaps_runs(self):
        at = re.search(r"^1 1 (\S+) (\S+) 0$", (self.folder / "x/point_001/start.data").read_text(), re.MULTILINE)
        x, y = map(float, at.groups())
        self.change_start("point_001", r"^2 1 \S+ \S+ 0$", f"2 1 {x + 5e-7!r} {y!r} 0")
        for script in ("single_point", "nve"):
            log = self.run_script("point_001", script)
        self.assertIn(f"{STEPS} steps", log)

    def test_a_case_at_rest_is_not_tilted_and_a_sheared_one_is_where_it_has_to_be(self):
        self.assertNotIn("triclinic", self.run_script(*FREE))
        self.assertNotIn("triclinic", self.run_script("point_002", "nve", steps=10))
        self.assertIn("triclinic", self.run_script(*SHEARED, steps=100))
        self.assertGreater(len({row["tilt"] for row in self.series(*SHEARED).values()}), 8)

    def test_lists_are_never_too_old_however_fast_a_particle_is(self):
        # One particle is fast from the start on; or all become fast, since the temperature asked for is high.
        for velocity, variables in (("21 -21", {}), ("2 2", {"temperature": 40})):
            with self.subTest(variables):
                self.change_start("point_002", r"^3 \S+ \S+ 0\n4 (?!1 )", f"3 {velocity} 0\n4 ")
                self.run_script(*SHEARED, steps=60, every=1, frame_steps=1, **variables)
                frames = self.frames("x/point_002/sheared.dump")
                for step, row in list(self.series(*SHEARED).items())[1:]:
                    # Forces have seen the box of the step before.
                    self.assertAlmostEqual(row["potential_energy"], self.energy(*frames[step], -0.5 * 12 * 0.05),
                                           delta=1e-7, msg=f"step {step}")

    def test_frames_hold_the_tilt_of_their_step_and_the_series_that_of_the_step_before(self):
        self.run_script(*SHEARED, steps=50, every=2, frame_steps=2)
        frames = self.frames("x/point_002/sheared.dump")
        for step, row in list(self.series(*SHEARED).items())[1:]:
            shift = (frames[step][1] - row["tilt"] - 0.5 * 12 * 0.05) / 12
            self.assertAlmostEqual(shift, round(shift), delta=1e-9)

    def test_lists_of_thermal_particles_are_not_made_anew_in_every_step(self):
        log = self.run_script(*SHEARED, steps=400)
        every = [int(steps) for steps in re.findall(r"^neigh_modify every (\d+) delay", log, re.MULTILINE)]
        self.assertGreater(max(every), 1)
        log = self.run_script(*SHEARED, steps=400, rebuild=1)
        self.assertEqual(set(re.findall(r"^neigh_modify every (\d+) delay", log, re.MULTILINE)), {"1"})

    def frames(self, dump):
        """Positions and tilt by step."""
        frames = {}
        for text in (self.folder / dump).read_text().split("ITEM: TIME\n")[1:]:
            lines = text.splitlines()
            rows = (line.split() for line in lines[10:])
            frames[int(lines[2])] = [tuple(map(float, row[1:3])) for row in rows], float(lines[6].split()[2])
        return frames

    def energy(self, positions, tilt, change_of_tilt):
        """Per particle, by brute force, in a box of 12 by 12."""
        total = 0.0
        for i, (x, y) in enumerate(positions):
            for other_x, other_y in positions[:i]:
                turns = round((y - other_y) / 12)
                dy = y - other_y - turns * 12
                dx = x - other_x - turns * (tilt + change_of_tilt)
                dx -= 12 * round(dx / 12)
                if (square := dx * dx + dy * dy) < 9:
                    part = math.sqrt(square) / 3
                    total += 5 / (9 * math.pi) * (1 + 3 * part) * (1 - part)**3
        return total / len(positions)


class Restarts(ScriptTest):
    def kill_and_go_on(self, folder, script):
        """Kills it at its second restart file, and goes on from the newer one."""
        place = self.folder / "x" / folder
        process = subprocess.Popen(self.command(script, {"restart_steps": 700, "frame_steps": 500}), cwd=place)
        files = [place / f"{script}.restart.{number}" for number in (1, 2)]
        for _ in range(3000):
            if files[1].exists() and files[1].stat().st_size >= files[0].stat().st_size:
                break
            time.sleep(0.01)
        process.kill()
        process.wait()
        self.assertFalse((place / f"{script}_final.data").exists(), "it was not killed in time")
        newer = max((1, 2), key=lambda number: files[number - 1].stat().st_mtime_ns)
        before = (place / f"{script}_series.dat").read_text().splitlines()
        self.run_script(folder, script, **{"from": newer, "restart_steps": 0, "frame_steps": 500})
        dump, = place.glob(f"{script}_from_*.dump")
        begin = int(dump.stem.rsplit("_", 1)[1])
        steps = re.findall(r"^ITEM: TIMESTEP\n(\d+)", dump.read_text(), re.MULTILINE)
        self.assertEqual(list(map(int, steps)), [step for step in range(0, STEPS + 1, 500) if step >= begin])
        self.expect(self.lucy("read-dump", place / f"{script}.dump"), 0)
        rows = self.series(folder, script)
        every = sorted(rows)[1]
        self.assertEqual(sorted(rows), list(range(0, STEPS + 1, every)))
        self.assertEqual((place / f"{script}_series.dat").read_text().splitlines()[:len(before) - 1], before[:-1])
        return rows

    def test_a_run_at_constant_energy_that_was_killed_goes_on(self):
        rows = self.kill_and_go_on(*FREE)
        energies = [row["energy"] for row in rows.values()]
        self.assertLess(max(energies) - min(energies), 5e-4 * energies[0])
        process = self.lucy("lammps", "run", "x")
        self.expect(process, 0)
        self.assertIn("run elsewhere", process.stdout)
        self.assertEqual(len(self.rows("x")), 2)

    def test_a_sheared_run_that_was_killed_goes_on_with_its_heat_and_its_tilt(self):
        rows = list(self.kill_and_go_on(*SHEARED).values())
        power = [-0.5 * 144 * row["pxy"] for row in rows]
        work = sum(0.5 * (a + b) * 0.2 for a, b in zip(power, power[1:]))
        heat = rows[-1]["heat"] - rows[0]["heat"] + rows[-1]["energy"] - rows[0]["energy"]
        self.assertAlmostEqual(heat / work, 1, delta=0.003)
        self.assertLessEqual(max(abs(row["tilt"]) for row in rows), 6 + 0.3)


if __name__ == "__main__":
    main_with_lammps()

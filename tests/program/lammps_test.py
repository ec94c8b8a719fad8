# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lucy lammps export`, `run` and `check` with the real LAMMPS. Where it is not installed: skipped: no LAMMPS."""

import csv
import json
import re
import shutil
import subprocess
import time

from running import ProgramTest, main_with_lammps

SMALL = """\
title = "a free and a sheared state"
[system]
particles = 144
energy_per_particle = 1
[shear]
strain_rate = [0.0, 0.5]
[run]
equilibration = 10
duration = 100
"""


class LammpsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("small.toml", SMALL)

    def lammps(self, *arguments, code=0, says=(), **options):
        process = self.lucy("lammps", *arguments, **options)
        self.expect(process, code, *says)
        return process

    def rows_of(self, series):
        return series.read_text().count("\n") if series.exists() else 0

    def kill_when(self, lucy, happened):
        """Kills a command as soon as something has happened, which must be before it ends."""
        while not happened():
            self.assertIsNone(lucy.poll(), "it had ended before")
            time.sleep(0.05)
        lucy.kill()
        lucy.communicate()

    def export(self, *arguments):
        return self.lammps("export", "small.toml", "--out", "x", *arguments)

    def run_script(self, folder, script, *variables):
        process = subprocess.run(["lmp", "-in", f"{script}.in", "-log", f"{script}.log", "-screen", "none", *variables],
                                 cwd=self.folder / folder, capture_output=True, text=True, timeout=300)
        log = (self.folder / folder / f"{script}.log").read_text()
        self.assertEqual(process.returncode, 0, log[-2000:])
        return log

    def series(self, path):
        lines = (self.folder / path).read_text().splitlines()
        names = lines[1].lstrip("# ").split()
        return [dict(zip(names, map(float, line.split()))) for line in lines if not line.startswith("#")]


class Export(LammpsTest):
    def test_every_script_runs_in_lammps_as_it_stands(self):
        self.export()
        self.assertEqual(self.entries("x"), [".lock", "README.txt", "export.json", "input.toml", "point_001",
                                             "point_002"])
        self.assertNotIn("sheared.in", self.entries("x/point_001"))
        for script in ("single_point", "exact_point", "nve"):
            self.run_script("x/point_001", script)
        for script in ("single_point", "exact_point", "nve", "sheared"):
            log = self.run_script("x/point_002", script)
        self.assertNotIn("ERROR", log)
        rows = self.series("x/point_002/sheared_series.dat")
        self.assertEqual(rows[-1]["time"], 110)
        self.assertLessEqual(max(abs(row["tilt"]) for row in rows), 6 + 0.3)

    def test_table_and_exact_form_agree_within_the_interpolation_error(self):
        self.export()
        for script in ("single_point", "exact_point"):
            self.run_script("x/point_002", script)
        table, exact = ([float(word) for word in (self.folder / f"x/point_002/{script}.txt").read_text().split()[-7:]]
                        for script in ("single_point", "exact_point"))
        for a, b in zip(table, exact):
            self.assertAlmostEqual(a, b, delta=1e-5 * max(1, abs(b)))
        self.assertNotEqual(table, exact)

    def test_the_temperature_of_a_sheared_case_is_that_of_the_ergostat(self):
        self.export()
        text = (self.folder / "x/point_002/sheared.in").read_text()
        temperature = float(re.search(r"variable temperature index (\S+)", text).group(1))
        self.assertAlmostEqual(temperature, 0.54, delta=0.02)
        self.assertRegex(text, r"# kT: 0\.5\d+\(\d+\), the mean of a run of Lucy's over 100 time units")
        self.lammps("export", "small.toml", "--out", "y", "--set", "system.kinetic_temperature=0.5")
        self.assertIn("variable temperature index 0.5\n", (self.folder / "y/point_002/sheared.in").read_text())

    def test_the_same_case_is_exported_once_and_another_one_nowhere_else(self):
        self.export()
        start = (self.folder / "x/point_001/start.data").read_bytes()
        self.assertIn("exported before", self.export().stdout)
        self.assertEqual((self.folder / "x/point_001/start.data").read_bytes(), start)
        self.lammps("export", "small.toml", "--out", "x", "--set", "run.seed=2", code=2, says=("another input",))

    def test_what_lammps_cannot_do_is_refused(self):
        self.lammps("export", "small.toml", "--out", "x", "--set", 'shear.thermostat="none"', code=2,
                    says=("shear.thermostat",))
        self.assertFalse((self.folder / "x").exists())
        self.lammps("export", "nowhere.toml", code=2, says=("nowhere.toml",))
        self.lammps("exprt", "small.toml", code=2)


class Run(LammpsTest):
    def test_ends_in_a_table_that_compare_takes(self):
        self.export("--set", "run.duration=600")
        process = self.lammps("run", "x")
        self.assertIn("ns per particle and step", process.stdout)
        rows = self.rows("x")
        self.assertEqual([float(row["strain_rate"]) for row in rows], [0, 0.5])
        self.assertEqual([row["status"] for row in rows], ["ok", "ok"])
        self.assertIn("LAMMPS", json.loads((self.folder / "x/provenance.json").read_text())["engine"])
        self.sweep("small.toml", "--out", "ours", "--set", "run.duration=600")
        self.assertEqual(list(rows[0]), list(self.rows("ours")[0]))
        compared = self.lucy("compare", "x", "--with", "ours/table.csv")
        self.assertIn(compared.returncode, (0, 1), compared.stderr)
        for ours, theirs in zip(self.rows("ours"), rows):
            for name in ("kinetic_temperature", "pxy_kinetic", "pxx_potential"):
                error = sum(float(row[name + "_error"])**2 for row in (ours, theirs))**0.5
                self.assertLess(abs(float(ours[name]) - float(theirs[name])), 4 * error + 1e-3, name)

    def test_what_is_done_is_not_run_again(self):
        self.export()
        self.lammps("run", "x")
        table = (self.folder / "x/table.csv").read_bytes()
        log = self.folder / "x/point_002/sheared.log"
        log.unlink()
        self.lammps("run", "x")
        self.assertFalse(log.exists())
        self.assertEqual((self.folder / "x/table.csv").read_bytes(), table)

    def test_what_was_run_by_hand_is_taken_as_it_is_and_needs_no_lammps_here(self):
        self.export("--set", "shear.strain_rate=0.5")
        self.run_script("x/point_001", "sheared")
        series = (self.folder / "x/point_001/sheared_series.dat").read_bytes()
        process = self.lammps("run", "x", environment=self.environment(PATH=str(self.folder)))
        self.assertIn("run elsewhere", process.stdout)
        self.assertEqual((self.folder / "x/point_001/sheared_series.dat").read_bytes(), series)
        engine = json.loads((self.folder / "x/provenance.json").read_text())["engine"]
        self.assertRegex(engine, r"LAMMPS \d+ \w+ \d+, run elsewhere")

    def test_needs_the_start_no_more_once_it_is_handed_over(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        (self.folder / "x/point_001/start.data").rename(self.folder / "mine.data")
        self.lammps("export", "small.toml", "--out", "y", "--set", "shear.strain_rate=0", "--set", "run.duration=20",
                    "--set", 'system.start="mine.data"')
        (self.folder / "mine.data").unlink()
        self.lammps("run", "y")
        self.assertEqual(len(self.rows("y")), 1)

    def test_other_ranks_are_no_reason_to_run_again(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        self.lammps("run", "x", "--ranks", "2")
        series = (self.folder / "x/point_001/nve_series.dat").read_bytes()
        self.assertIn("2 ranks", self.lammps("run", "x").stdout)
        self.assertEqual((self.folder / "x/point_001/nve_series.dat").read_bytes(), series)

    def test_a_series_that_is_cut_is_run_again(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        self.lammps("run", "x")
        series = self.folder / "x/point_001/nve_series.dat"
        whole = series.read_bytes()
        table = (self.folder / "x/table.csv").read_bytes()
        series.write_bytes(whole[:len(whole) // 2])
        self.lammps("run", "x")
        self.assertEqual(len(series.read_bytes()), len(whole))
        self.assertEqual((self.folder / "x/table.csv").read_bytes(), table)

    def test_another_script_or_start_is_run_again(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        self.lammps("run", "x")
        series = self.folder / "x/point_001/nve_series.dat"
        before = series.read_text()
        script = self.folder / "x/point_001/nve.in"
        script.write_text(script.read_text().replace("variable step index 0.05", "variable step index 0.02"))
        self.lammps("run", "x")
        self.assertNotEqual(series.read_text(), before)

    def test_killed_it_takes_lammps_along_and_goes_on_from_its_restart_file(self):
        self.export("--set", "shear.strain_rate=0.5", "--set", "run.duration=1500")
        case = self.folder / "x/point_001"
        script = case / "sheared.in"
        script.write_text(script.read_text().replace("restart_steps index 50000", "restart_steps index 2000"))
        series = case / "sheared_series.dat"
        for restart in ("2", "1"):
            lucy = self.start("lammps", "run", "x")
            self.kill_when(lucy, lambda: (case / f"sheared.restart.{restart}").exists() and self.rows_of(series) > 100)
            rows = -1
            while rows != self.rows_of(series):
                rows = self.rows_of(series)
                time.sleep(1)  # LAMMPS writes some of them several times a second
            self.assertFalse((case / "sheared.done").exists())
        process = self.lammps("run", "x")
        self.assertIn("went on after an interruption", process.stdout)
        times = sorted({row["time"] for row in self.series("x/point_001/sheared_series.dat")})
        self.assertEqual(len(times), 1510 * 5 + 1)
        row, = self.rows("x")
        self.assertEqual(row["status"], "ok")
        self.assertLess(abs(float(row["pxy_kinetic"]) + 0.2134), 4 * float(row["pxy_kinetic_error"]) + 0.002)
        self.assertEqual([name for name in self.entries("x/point_001") if "restart" in name or "begun" in name], [])
        self.lammps("run", "x")

    def test_restart_files_of_another_script_are_not_gone_on_from(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=2000")
        case = self.folder / "x/point_001"
        script = case / "nve.in"
        script.write_text(script.read_text().replace("restart_steps index 50000", "restart_steps index 2000"))
        lucy = self.start("lammps", "run", "x")
        self.kill_when(lucy, (case / "nve.restart.1").exists)
        script.write_text(script.read_text().replace("index 2000", "index 3000"))
        self.assertIn("steps in", self.lammps("run", "x").stdout)
        self.assertEqual(len(self.series("x/point_001/nve_series.dat")), 2010 * 5 + 1)

    def test_a_hole_in_a_series_is_told(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        self.lammps("run", "x")
        series = self.folder / "x/point_001/nve_series.dat"
        lines = series.read_text().splitlines(keepends=True)
        series.write_text("".join(lines[:40] + lines[45:]))
        self.lammps("run", "x", code=2, says=("nve_series.dat", "no row between"))

    def test_a_table_that_is_not_of_an_export_is_left_alone(self):
        self.sweep("small.toml", "--out", "ours")
        before = (self.folder / "ours/table.csv").read_bytes()
        self.lammps("export", "small.toml", "--out", "ours", code=2, says=("another input", "sweep"))
        (self.folder / "ours/README.txt").write_text("mine")
        self.lammps("run", "ours", code=2, says=("input.toml", "lammps export"))
        self.assertEqual((self.folder / "ours/table.csv").read_bytes(), before)
        self.export("--set", "run.duration=20")
        self.sweep("small.toml", "--set", "run.duration=20", "--out", "x", code=2, says=("another input", "LAMMPS"))
        self.lammps("check", "small.toml", "--set", "run.duration=20", "--out", "x", code=2, says=("another input",))

    def test_a_program_beside_the_directory_is_found(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        (self.folder / "bin").mkdir()
        (self.folder / "bin/lmp").symlink_to(shutil.which("lmp"))
        self.lammps("run", "x", "--lammps", "bin/lmp")
        self.assertEqual(len(self.rows("x")), 1)

    def test_more_ranks_than_cores_end_in_words(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        process = self.lucy("lammps", "run", "x", "--ranks", "5000")
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stderr, r"ranks|slots|processes|resources")
        self.assertNotIn("-----", process.stderr)

    def test_the_energy_error_of_a_step_is_not_claimed(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=20")
        self.lammps("run", "x")
        self.assertEqual(self.rows("x")[0]["worst_energy_error"], "nan")

    def test_two_ranks_end_with_the_same_averages(self):
        self.export("--set", "run.duration=20")
        self.lammps("run", "x", "--ranks", "2")
        self.assertEqual(len(self.rows("x")), 2)
        self.assertAlmostEqual(float(self.rows("x")[0]["kinetic_temperature"]), 0.54, delta=0.05)

    def test_a_series_is_what_green_kubo_takes(self):
        self.export("--set", "shear.strain_rate=0", "--set", "run.duration=2000")
        self.lammps("run", "x")
        process = self.lucy("green-kubo", "--from-series", "x/point_001/nve_series.dat", "--interval", "0.2",
                            "--volume", "144", "--temperature", "0.54", "--out", "gk", "--no-pictures")
        self.assertEqual(process.returncode, 0, process.stderr)

    def test_frames_of_the_sheared_run_start_a_sweep(self):
        self.export("--set", "run.duration=20", "--set", "output.frame_interval=5")
        self.lammps("run", "x")
        process = self.lucy("read-dump", "x/point_002/sheared.dump", "--strain-rate", "0.5")
        self.expect(process, 0)
        self.assertIn("7 frames", process.stdout)
        sweep = ["small.toml", "--set", "shear.strain_rate=0.5", "--set", 'system.start="x/point_002/sheared.dump"']
        self.sweep(*sweep, "--out", "wrong", code=2, says=("a flow in its velocities", "start_strain_rate"))
        self.sweep(*sweep, "--out", "right", "--set", "system.start_strain_rate=0.5")
        self.assertEqual(len(self.rows("right")), 1)

    def test_words_of_lammps_are_passed_on(self):
        self.export()
        script = self.folder / "x/point_001/nve.in"
        script.write_text(script.read_text().replace("pair_style table", "pair_style tabel"))
        self.lammps("run", "x", code=1, says=("nve.in", "tabel"))

    def test_bad_usage_is_refused(self):
        self.lammps("run", "nowhere", code=2, says=("nowhere", "export"))
        self.export()
        self.lammps("run", "x", "--ranks", "0", code=2, says=("--ranks",))


class Check(LammpsTest):
    def test_a_small_check_agrees_and_is_printed_again(self):
        arguments = ("check", "small.toml", "--out", "c", "--set", "run.duration=600")
        first = self.lammps(*arguments)
        self.assertIn("Both engines agree", first.stdout)
        with open(self.folder / "c/verdict.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        exact = [line for line in lines if "exact form" in line["part"]]
        self.assertEqual(len(exact), 10)
        for line in exact:
            self.assertLess(abs(float(line["difference"])), 1e-10)
        heat = [line for line in lines if line["quantity"] == "heat removed over work"]
        self.assertEqual(len(heat), 4)
        again = self.lammps(*arguments)
        self.assertIn("nothing was run", again.stdout)
        self.assertEqual(first.stdout.split("\nLAMMPS 29")[0], again.stdout.split("\nThis check")[0])
        for engine in ("lucy", "lammps"):
            self.assertEqual(len(self.rows(f"c/{engine}")), 5)

    def test_keeps_the_density_and_range_of_the_input_where_the_state_is_the_inputs(self):
        process = self.lucy("lammps", "check", "small.toml", "--out", "c", "--set", "run.duration=20", "--set",
                            "system.density=0.5", "--set", "kernel.range=4")
        self.assertIn("Shear at E/N = 1 and rate 0.1 (density 1 and range 3)", process.stdout)
        for folder, edge in (("constant_energy", 288**0.5), ("free_point", 288**0.5), ("shear_1_0.5", 12)):
            text = (self.folder / f"c/{folder}/start.data").read_text()
            self.assertAlmostEqual(float(re.search(r"\n0 (\S+) xlo xhi", text).group(1)), edge, places=9)
            table = (self.folder / f"c/{folder}/lucy.table").read_text()
            self.assertIn("range 3" if edge == 12 else "range 4", table)
        with open(self.folder / "c/verdict.csv", newline="") as file:
            lines = [line for line in csv.DictReader(file) if "exact form" in line["part"]]
        self.assertEqual({line["verdict"] for line in lines}, {"agrees"})

    def test_what_the_input_makes_impossible_is_refused_before_anything_is_written(self):
        self.lammps("check", "small.toml", "--out", "c", "--set", "system.energy_per_particle=0.3", code=2,
                    says=("energy_per_particle",))
        self.assertFalse((self.folder / "c").exists())

    def test_killed_it_goes_on_where_it_was(self):
        arguments = ("lammps", "check", "small.toml", "--out", "c", "--set", "run.duration=300")
        lucy = self.start(*arguments)
        points = self.folder / "c/tasks/single_points/verdict.csv"
        self.kill_when(lucy, points.exists)
        before = points.stat().st_mtime_ns
        process = self.lucy(*arguments)
        self.assertIn("Shear at E/N = 0.5 and rate 0.5", process.stdout)
        self.assertEqual(points.stat().st_mtime_ns, before)
        self.assertEqual(process.returncode, 1 if "UNKNOWN" in process.stdout else 0)

    def test_a_line_that_differs_or_has_no_error_bar_is_told_and_ends_with_one(self):
        arguments = ("check", "small.toml", "--out", "c", "--set", "run.duration=20")
        short = self.lucy("lammps", *arguments)
        self.assertEqual(short.returncode, 1)
        self.assertIn("UNKNOWN", short.stdout)
        verdict = self.folder / "c/verdict.csv"
        text = verdict.read_text().splitlines()
        cells = text[1].split(",")
        cells[6] = "0.1"
        text[1] = ",".join(cells)
        verdict.write_text("\n".join(text) + "\n")
        again = self.lucy("lammps", *arguments)
        self.assertEqual(again.returncode, 1)
        self.assertIn("DIFFERS", again.stdout)


class Absent(LammpsTest):
    def test_says_in_one_sentence_how_to_install_it(self):
        nowhere = self.environment(PATH=str(self.folder))
        self.export()
        for arguments in (("run", "x"), ("check", "small.toml", "--out", "c")):
            self.lammps(*arguments, code=1, says=("apt-get install lammps",), environment=nowhere)
        self.assertFalse((self.folder / "c").exists())
        self.lammps("run", "x", "--lammps", "/bin/true", code=1, says=("/bin/true", "not LAMMPS"))


if __name__ == "__main__":
    main_with_lammps()

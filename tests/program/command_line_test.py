# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: exit codes and messages, what is refused and that nothing is touched then, and `lucy compare`."""

import csv
import os
import resource
import shutil
import subprocess
import unittest

from running import PROGRAM, SOURCE, ProgramTest


class CommandLine(ProgramTest):
    def test_no_arguments_give_a_short_help(self):
        process = self.lucy()
        self.assertEqual((process.returncode, process.stdout), (2, ""))
        for command in ("sweep", "check", "compare", "explain"):
            self.assertIn(f"lucy {command}", process.stderr)

    def test_version_and_help(self):
        version = self.lucy("--version")
        self.expect(version, 0)
        for word in ("lucy 0.1.0", "commit", "compiler", "flags"):
            self.assertIn(word, version.stdout)
        self.assertIn("Exit codes", self.lucy("--help").stdout)
        for command in ("sweep", "check", "compare", "explain"):
            process = self.lucy(command, "--help")
            self.expect(process, 0)
            self.assertIn(f"Usage: lucy {command}", process.stdout)
            self.assertIn("Example", process.stdout)
            self.assertEqual(process.stderr, "")

    def test_mistyped_words_get_the_nearest_name(self):
        self.expect(self.lucy("swep", "tiny.toml"), 2, "'swep'", "did you mean sweep?")
        self.expect(self.lucy("sweep", "tiny.toml", "--oot", "x"), 2, "--oot", "did you mean --out?")
        self.expect(self.lucy("--verson"), 2, "--verson", "did you mean --version?")
        self.expect(self.lucy("sweep", "tiny.toml", "--set", "run.stp=3"), 2, "stp", "step")
        self.expect(self.lucy("compare", "x.csv", "--with", "posch1995_table3"), 2)
        self.assertEqual(self.entries(), ["tiny.toml"])

    def test_wrong_usage(self):
        self.expect(self.lucy("sweep"), 2, "INPUT")
        self.expect(self.lucy("sweep", "tiny.toml", "other.toml"), 2, "other.toml")
        self.expect(self.lucy("sweep", "tiny.toml", "--set"), 2, "--set")
        self.expect(self.lucy("sweep", "tiny.toml", "--out"), 2, "--out")
        self.expect(self.lucy("sweep", "tiny.toml", "--out", ""), 2, "--out")
        self.expect(self.lucy("compare", "tiny.toml"), 2, "--with")
        self.expect(self.lucy("explain", "run.stepp"), 2, "stepp")
        self.assertEqual(self.entries(), ["tiny.toml"])

    def test_bad_input_is_refused_and_nothing_is_written(self):
        (self.folder / "directory.toml").mkdir()
        (self.folder / "binary.toml").write_bytes(bytes(range(256)) * 20)
        before = self.entries()
        for arguments, says in (
            (["nowhere.toml"], "nowhere.toml"),
            (["directory.toml"], "directory.toml"),
            (["binary.toml"], "binary.toml"),
            (["tiny.toml", "--set", "run.step=0.3"], "run.step"),
            (["tiny.toml", "--set", "run.step=nan"], "run.step"),
            (["tiny.toml", "--set", "run.duration=-1"], "duration"),
            (["tiny.toml", "--set", "shear.strain_rate=[]"], "strain_rate"),
            (["tiny.toml", "--set", "system.energy_per_particle=0.4"], "energy_per_particle"),
            (["tiny.toml", "--set", "system.particles=25"], "particles"),
            (["tiny.toml", "--set", "run.replicas=2.5"], "replicas"),
        ):
            for command in ("sweep", "check"):
                process = self.lucy(command, *arguments)
                self.expect(process, 2, says)
                self.assertEqual(process.stdout, "")
        self.assertEqual(self.entries(), before)

    def test_what_memory_cannot_hold_is_refused_before_anything_is_written(self):
        allowed = (8 << 30, 8 << 30)
        process = self.lucy("sweep", "tiny.toml", "--out", "x", "--set", "system.particles=100000000",
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, allowed))
        self.expect(process, 2, "system.particles = 100000000", "GB of memory", "there are 9 GB")
        self.assertEqual(self.entries(), ["tiny.toml"])

    def test_an_unknown_kind_of_input_names_those_there_are(self):
        for command in ("check", "explain"):
            for kind in ("shearflow", "3"):
                self.expect(self.lucy(command, *["tiny.toml"] * (command == "check"), "--for", kind), 2,
                            f'--for = "{kind}"', "sweep, green-kubo", "shear-flow")

    def test_explain_says_whose_input_has_a_key_that_this_one_has_not(self):
        for filter in ("fluid.viscosity", "[fluid]", "conductivity"):
            self.expect(self.lucy("explain", filter), 2, "--for shear-flow or --for shear-wave")
        self.expect(self.lucy("explain", "fluid.viscosty"), 2, "no section or key")

    def test_check_predicts_and_writes_nothing(self):
        process = self.lucy("check", "tiny.toml", "--set", "run.threads=1", "--set", "run.target_relative_error=0.01")
        self.expect(process, 0)
        for word in ("2 points, 1 thread", "isoenergetic", "60 to 600", "particle-steps", "ns per particle and step",
                     "wall time", "disk"):
            self.assertIn(word, process.stdout)
        # 36 particles, (3 + 60)/0.05 steps, two replicas, two points; at most (3 + 600)/0.05.
        self.assertIn("work: 181 thousand to 1.74 million particle-steps", process.stdout)
        self.assertEqual(self.entries(), ["tiny.toml"])

    def test_check_names_keys_without_effect(self):
        sets = ["--set", "system.kinetic_temperature=0.5", "--set", "shear.relaxation_time=3", "--set",
                "run.maximum_duration=100"]
        process = self.lucy("check", "tiny.toml", *sets)
        self.expect(process, 0)
        for key in ("system.kinetic_temperature", "shear.relaxation_time", "run.maximum_duration"):
            self.assertIn(f"without effect: {key} (used only with ", process.stdout)
        process = self.lucy("check", "tiny.toml", *sets, "--set", "shear.thermostat='nose-hoover'", "--set",
                            "run.target_relative_error=0.1")
        self.expect(process, 0)
        self.assertNotIn("without effect", process.stdout)
        self.assertNotIn("without effect", self.lucy("check", "tiny.toml").stdout)

    def test_explain_names_every_key(self):
        text = self.lucy("explain").stdout
        for key in ("particles", "energy_per_particle", "strain_rate", "thermostat", "target_relative_error",
                    "frame_interval", "checkpoint_interval"):
            self.assertIn(key, text)
        self.assertNotIn("particles", self.lucy("explain", "run.step").stdout)

    def test_a_reader_that_goes_away_is_no_error(self):
        for command in ("explain", "check tiny.toml"):
            piped = subprocess.run(f"{PROGRAM} {command} | true; echo ${{PIPESTATUS[0]}}", shell=True,
                                   executable="/bin/bash", cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((piped.stdout, piped.stderr), ("0\n", ""))

    def test_full_standard_output_is_told(self):
        with open("/dev/full", "w") as full:
            process = subprocess.run([PROGRAM, "explain"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(process.returncode, 1)
        self.assertIn("standard output", process.stderr)


class Directories(ProgramTest):
    def test_the_default_is_runs_and_the_name_of_the_input(self):
        self.sweep("tiny.toml")
        self.assertIn("table.csv", self.entries("runs/tiny"))

    def test_a_sweep_ends_well_when_its_reader_goes_away(self):
        command = f"{PROGRAM} sweep tiny.toml --out x | head -c 1 > /dev/null; echo ${{PIPESTATUS[0]}}"
        for _ in range(2):  # run, and printed again
            piped = subprocess.run(command, shell=True, executable="/bin/bash", cwd=self.folder, capture_output=True,
                                   text=True, env=self.environment(pictures=True))
            self.assertEqual((piped.stdout, piped.stderr), ("0\n", ""))
            self.assertIn("table.csv", self.entries("x"))
            self.assertNotIn("checkpoints", self.entries("x"))

    def test_a_directory_that_may_not_be_written_to_is_refused(self):
        (self.folder / "x").mkdir()
        (self.folder / "x").chmod(0o555)
        options = {}
        if os.geteuid() == 0:  # who may write everywhere
            self.folder.chmod(0o755)
            options = {"user": 65534}
        try:
            process = self.lucy("sweep", "tiny.toml", "--out", "x", **options)
        except OSError as refusal:
            self.skipTest(f"not as somebody else: {refusal}")
        self.expect(process, 2, "x/.lock", "Permission denied", "--out")
        self.assertEqual(self.entries("x"), [])

    def test_an_empty_directory_is_used(self):
        (self.folder / "empty").mkdir()
        self.sweep("tiny.toml", "--out", "empty")
        names = self.entries("empty")
        for name in ("input.toml", "table.csv", "replicas.csv", "notes.txt", "provenance.json", "point_001.h5",
                     "point_002.h5"):
            self.assertIn(name, names)
        self.assertNotIn("checkpoints", names)
        self.assertNotIn("point_003.h5", names)

    def test_the_resolved_input_is_an_input_with_the_same_results(self):
        self.sweep("tiny.toml", "--out", "one", "--set", "run.seed=7")
        self.sweep("one/input.toml", "--out", "two")
        self.assertEqual(self.contents("one", ("table.csv", "replicas.csv", "input.toml")),
                         self.contents("two", ("table.csv", "replicas.csv", "input.toml")))

    def test_a_finished_sweep_is_printed_again_and_not_run(self):
        first = self.sweep("tiny.toml", "--out", "x")
        times = {name: (self.folder / "x" / name).stat().st_mtime_ns for name in self.entries("x") if name != ".lock"}
        again = self.sweep("tiny.toml", "--out", "x", "--set", "run.threads=1")  # threads make no other sweep
        self.assertIn("nothing was run", again.stdout)
        table = first.stdout.split("\nTook")[0]
        self.assertIn("viscosity", table)
        self.assertTrue(again.stdout.startswith(table), again.stdout)
        self.assertEqual(times, {name: (self.folder / "x" / name).stat().st_mtime_ns for name in times})

    def test_a_missing_plot_is_drawn_when_the_table_is_printed_again(self):
        self.sweep("tiny.toml", "--out", "x")
        self.assertNotIn("viscosity.png", self.entries("x"))
        process = self.sweep("tiny.toml", "--out", "x", environment=self.environment(pictures=True))
        if "there is no Python" in process.stdout:
            self.skipTest("no matplotlib here")
        self.assertIn("viscosity.png", self.entries("x"))

    def test_a_table_that_was_damaged_is_not_believed(self):
        self.sweep("tiny.toml", "--out", "x")
        path = self.folder / "x" / "table.csv"
        lines = path.read_text().splitlines(keepends=True)
        path.write_text("".join(lines[:-1]))
        self.sweep("tiny.toml", "--out", "x", code=1, says=["table.csv", "remove x/table.csv"])
        path.write_text("".join(lines).replace(",ok\n", ",fine\n"))
        self.sweep("tiny.toml", "--out", "x", code=1, says=["table.csv", "fine"])
        path.unlink()
        self.sweep("tiny.toml", "--out", "x")
        self.assertEqual(path.read_text(), "".join(lines))

    def test_anything_else_is_refused_and_stays_as_it_is(self):
        self.sweep("tiny.toml", "--out", "x")
        (self.folder / "foreign").mkdir()
        self.write("foreign/thesis.tex", "years of work")
        before = {path: path.stat().st_mtime_ns for path in self.folder.rglob("*")}
        self.sweep("tiny.toml", "--out", "x", "--set", "run.seed=2", code=2, says=["x holds", "seed = 2", "--out"])
        self.sweep("tiny.toml", "--out", "foreign", code=2, says=["foreign", "thesis.tex", "--out"])
        self.sweep("tiny.toml", "--out", "tiny.toml", code=2, says=["tiny.toml is a file", "--out"])
        self.sweep("tiny.toml", "--out", "tiny.toml/below", code=2, says=["tiny.toml/below", "--out"])
        self.assertEqual(before, {path: path.stat().st_mtime_ns for path in self.folder.rglob("*")})

    def test_two_programs_do_not_share_a_directory(self):
        first = self.start("sweep", "tiny.toml", "--out", "x", "--set", "run.duration=1e6")
        try:
            while not (self.folder / "x" / "checkpoints").exists():
                self.assertIsNone(first.poll())
            self.sweep("tiny.toml", "--out", "x", "--set", "run.duration=1e6", code=2, says=[str(first.pid), "--out"])
        finally:
            first.kill()
            first.wait()
            first.stderr.close()

    def test_a_lock_that_was_left_behind_blocks_nobody(self):
        (self.folder / "x").mkdir()
        self.write("x/.lock", "1\n")
        self.sweep("tiny.toml", "--out", "x")


class Compare(ProgramTest):
    def setUp(self):
        super().setUp()
        # A table that holds the published numbers, except for what is misprinted, with errors of its own.
        with open(SOURCE / "reference" / "posch1995_table2.csv", newline="") as file:
            published = [row for row in csv.DictReader(file) if float(row["strain_rate"]) == 0.1]
        self.sweep("tiny.toml", "--out", "x")
        header = list(self.rows("x")[0])
        row = dict.fromkeys(header, "nan")
        printed = published[0]
        row.update(particles=printed["particles"], energy_per_particle=1, strain_rate=0.1, step=0.05, duration=2000,
                   replicas=2, equilibration_discarded=0, worst_energy_error=0, subdivided_steps=0, status="ok")
        for name in ("pxy_kinetic", "pxy_potential", "pxx_kinetic", "pxx_potential", "pyy_kinetic", "pyy_potential"):
            row[name], row[name + "_error"] = printed[name], 0.0005
        row["viscosity"] = -(float(printed["pxy_kinetic"]) + float(printed["pxy_potential"])) / 0.1
        row["viscosity_error"] = 0.007
        self.row, self.header = row, header
        shutil.rmtree(self.folder / "x")

    def write_table(self, **changes):
        (self.folder / "t").mkdir(exist_ok=True)
        row = {**self.row, **changes}
        self.write("t/table.csv", ",".join(self.header) + "\n" + ",".join(str(row[name]) for name in self.header) + "\n")

    def test_agreement_is_exit_code_0_by_file_or_directory(self):
        self.write_table()
        for table in ("t/table.csv", "t"):
            process = self.lucy("compare", table, "--with", "posch1995_table2")
            self.expect(process, 0)
            self.assertIn("Verdict: agree", process.stdout)

    def test_disagreement_is_exit_code_1(self):
        self.write_table(pxy_kinetic=-0.2)
        process = self.lucy("compare", "t", "--with", "posch1995_table2")
        self.assertEqual((process.returncode, process.stderr), (1, ""))
        self.assertIn("DISAGREES", process.stdout)

    def test_a_table_without_errors_cannot_agree(self):
        self.write_table(**{name: "nan" for name in self.header if name.endswith("_error") and "energy" not in name})
        self.assertEqual(self.lucy("compare", "t", "--with", "posch1995_table2").returncode, 1)

    def test_bad_input_is_exit_code_2(self):
        self.write_table()
        self.expect(self.lucy("compare", "nowhere.csv", "--with", "posch1995_table2"), 2, "nowhere.csv")
        self.expect(self.lucy("compare", "t", "--with", "posch1995_table9"), 2, "posch1995_table9", "posch1995_table2")
        self.expect(self.lucy("compare", "t", "--with", "posch1995_table1"), 2, "nothing to compare")
        self.expect(self.lucy("compare", "tiny.toml", "--with", "posch1995_table2"), 2, "tiny.toml")

    def test_a_table_agrees_with_itself(self):
        self.write_table()
        self.assertEqual(self.lucy("compare", "t", "--with", "t/table.csv").returncode, 0)
        for directory in ("t", "./t", str(self.folder / "t")):
            self.expect(self.lucy("compare", "t", "--with", directory), 0)
        (self.folder / "empty").mkdir()
        self.expect(self.lucy("compare", "t", "--with", "empty"), 2, "empty/table.csv")


if __name__ == "__main__":
    unittest.main()

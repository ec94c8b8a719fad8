// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of a sweep: every refusal with its sentence, overrides, lists, tables of rows, the resolved text.
#include "lucy/files/input.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "input_folder.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/schema.hpp"
#include "shared_sections.hpp"

namespace lucy::files {
namespace {

using Reals = std::vector<double>;

using testing::contains;
using testing::ends_with;
using testing::lacks;
using testing::Overrides;
using testing::starts_with;
using testing::with;

class InputTest : public testing::FolderReadBy<read_sweep> {
 protected:
  std::string refusal_of(const std::filesystem::path& path) const {
    return refusal_from([&] { read_sweep(path); });
  }
};

/// Lines 1 to 11 of a file that is accepted.
const std::string minimal = R"([system]
particles = 64
energy_per_particle = 1

[shear]
strain_rate = 0.5

[run]
duration = 100

# end
)";

std::vector<double> strain_rates(const SweepInput& input) {
  std::vector<double> rates;
  for (const auto& point : input.points) rates.push_back(point.strain_rate);
  return rates;
}

std::vector<double> durations(const SweepInput& input) {
  std::vector<double> values;
  for (const auto& point : input.points) values.push_back(point.duration);
  return values;
}

std::vector<double> energies(const SweepInput& input) {
  std::vector<double> values;
  for (const auto& point : input.points) values.push_back(point.energy_per_particle);
  return values;
}

/// Every key of a point as text with all its bits.
std::string fingerprint(const SweepInput& input) {
  std::string text = input.title;
  const auto bits = [](double value) { return fmt::format(" {:016x}", std::bit_cast<std::uint64_t>(value)); };
  for (const auto& p : input.points) {
    text += fmt::format("\n{} {} {} {} {} {} {} {} {}", p.particles, p.dimension, static_cast<int>(p.reading), p.kernel,
                        static_cast<int>(p.thermostat), static_cast<int>(p.integrator), p.replicas, p.seed, p.rescale);
    for (const double value :
         {p.energy_per_particle, p.density, p.kinetic_temperature.value_or(-1), p.range, p.strain_rate,
          p.relaxation_time, p.step, p.equilibration, p.duration, p.target_relative_error.value_or(-1),
          p.maximum_duration, p.energy_tolerance, p.sample_interval, p.frame_interval})
      text += bits(value);
  }
  return text;
}

const std::filesystem::path shipped = std::filesystem::path(LUCY_SOURCE_DIRECTORY) / "inputs";

// What is accepted ------------------------------------------------------------------------------------------------

TEST_F(InputTest, DefaultsAreThoseOfThePoint) {
  const SweepInput input = read(minimal);
  ASSERT_EQ(input.points.size(), 1u);
  cases::CouettePoint expected;
  expected.particles = 64;
  expected.energy_per_particle = 1.0;
  expected.strain_rate = 0.5;
  expected.duration = 100.0;
  SweepInput by_hand;
  by_hand.points = {expected};
  EXPECT_EQ(fingerprint(input), fingerprint(by_hand));
  EXPECT_EQ(input.threads, 0);
  EXPECT_EQ(input.checkpoint_interval, 10.0);
}

TEST_F(InputTest, EveryKeyReachesItsPlace) {
  const SweepInput input = read(R"(title = "all keys"
[system]
particles = 100
energy_per_particle = 1.5
density = 0.9
dimension = 2
reading = "md"
kinetic_temperature = 0.6
[kernel]
name = "lucy"
range = 2.5
[shear]
strain_rate = -0.25
thermostat = "nose-hoover"
relaxation_time = 2
[run]
)" + testing::run_keys +
                                R"(integrator = "rk4"
target_relative_error = 0.01
maximum_duration = 500
rescale = false
[output]
sample_interval = 0.4
frame_interval = 10
)");
  testing::expect_run_keys(input);
  const auto& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(point.particles, 100);
  EXPECT_EQ(point.energy_per_particle, 1.5);
  EXPECT_EQ(point.density, 0.9);
  EXPECT_EQ(point.kinetic_temperature, 0.6);
  EXPECT_EQ(point.range, 2.5);
  EXPECT_EQ(point.strain_rate, -0.25);
  EXPECT_EQ(point.thermostat, motion::Thermostat::nose_hoover);
  EXPECT_EQ(point.relaxation_time, 2.0);
  EXPECT_EQ(point.target_relative_error, 0.01);
  EXPECT_EQ(point.maximum_duration, 500.0);
  EXPECT_FALSE(point.rescale);
  EXPECT_EQ(point.sample_interval, 0.4);
  EXPECT_EQ(point.frame_interval, 10.0);
}

TEST_F(InputTest, ZeroStrainRateAndLineEndingsOfOtherSystemsAreAccepted) {
  std::string text = with(minimal, "0.5", "-0.0");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  const SweepInput input = read("\xef\xbb\xbf" + text);
  EXPECT_EQ(input.points.front().strain_rate, 0.0);
  EXPECT_FALSE(std::signbit(input.points.front().strain_rate));
}

// Lists -----------------------------------------------------------------------------------------------------------

TEST_F(InputTest, ListsMultiplyWithTheEnergiesOutermost) {
  const auto text = with(minimal, "energy_per_particle = 1", "energy_per_particle = [0.5, 1]");
  const SweepInput input = read(with(text, "strain_rate = 0.5", "strain_rate = [0.1, 0.2, 1]"));
  EXPECT_EQ(energies(input), (Reals{0.5, 0.5, 0.5, 1.0, 1.0, 1.0}));
  EXPECT_EQ(strain_rates(input), (Reals{0.1, 0.2, 1.0, 0.1, 0.2, 1.0}));
}

TEST_F(InputTest, DurationEquilibrationAndStepMayHaveOneEntryPerStrainRate) {
  auto text = with(minimal, "energy_per_particle = 1", "energy_per_particle = [0.5, 1]");
  text = with(text, "strain_rate = 0.5", "strain_rate = [0.1, 0.2]");
  text = with(text, "duration = 100", "duration = [300, 200]\nequilibration = [30, 20]\nstep = [0.02, 0.05]");
  const SweepInput input = read(text);
  EXPECT_EQ(durations(input), (Reals{300.0, 200.0, 300.0, 200.0}));
  ASSERT_EQ(input.points.size(), 4u);
  EXPECT_EQ(input.points[2].equilibration, 30.0);
  EXPECT_EQ(input.points[3].step, 0.05);
}

TEST_F(InputTest, ListsOfTheWrongLengthAreRefusedWithBothLengths) {
  const auto rates = with(minimal, "strain_rate = 0.5", "strain_rate = [0.1, 0.2, 0.5]");
  EXPECT_EQ(refusal(with(rates, "duration = 100", "duration = [100, 200]")),
            "a.toml:9: run.duration is a list of 2, but shear.strain_rate has 3 values; give one number, or one per "
            "entry");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "duration = 100", "duration = [100, 200]")),
               "a.toml:9: run.duration is a list of 2, but shear.strain_rate has 1 value;");
  EXPECT_EQ(refusal(with(rates, "duration = 100", "duration = [1, 2, 3]"), {"shear.strain_rate=[0.1, 0.2]"}),
            "a.toml:9: run.duration is a list of 3, but shear.strain_rate has 2 values; give one number, or one per "
            "entry");
}

TEST_F(InputTest, ListsAreRefusedWhereTheyMeanNothing) {
  EXPECT_EQ(refusal(with(minimal, "strain_rate = 0.5", "strain_rate = []")),
            "a.toml:6: shear.strain_rate must be a finite number, or a list of such numbers, but is an empty list");
  EXPECT_EQ(refusal(with(minimal, "particles = 64", "particles = [64, 100]")),
            "a.toml:2: system.particles must be an integer from 4 to 100000000, but is a list");
  EXPECT_PRED2(contains, refusal(with(minimal, "= 0.5\n", "= [0.1, [0.2]]\n")), "but holds a list");
  EXPECT_EQ(refusal(with(minimal, "= 0.5\n", "= [0.1, \"fast\"]\n")),
            "a.toml:6: shear.strain_rate = \"fast\" must be a finite number");
}

TEST_F(InputTest, ListsThatMultiplyToTooManyRowsAreRefused) {
  std::string list = "[1";
  for (int i = 2; i <= 200; ++i) list += fmt::format(", {}", i);
  list += "]";
  EXPECT_PRED2(contains, refusal(minimal, {"system.energy_per_particle=" + list, "shear.strain_rate=" + list}),
               "at most 10000 are accepted");
}

// Tables of rows --------------------------------------------------------------------------------------------------

const std::string with_points = R"([system]
particles = 64
energy_per_particle = 1
[run]
equilibration = 10
[[point]]
strain_rate = 0.1
duration = 1000
[[point]]
particles = 100
run.duration = 200
[point.shear]
strain_rate = 0.5
[[point]]
strain_rate = 1.0
duration = 300
equilibration = 5
thermostat = "none"
)";

TEST_F(InputTest, PointTablesAreTheRowsAndOverrideTheSections) {
  const SweepInput input = read(with_points);
  EXPECT_EQ(strain_rates(input), (Reals{0.1, 0.5, 1.0}));
  EXPECT_EQ(durations(input), (Reals{1000.0, 200.0, 300.0}));
  EXPECT_EQ(input.points[0].particles, 64);
  EXPECT_EQ(input.points[1].particles, 100);
  EXPECT_EQ(input.points[1].equilibration, 10.0);
  EXPECT_EQ(input.points[2].equilibration, 5.0);
  EXPECT_EQ(input.points[2].thermostat, motion::Thermostat::none);
}

TEST_F(InputTest, PointTablesMayBeWrittenInline) {
  const SweepInput input = read("point = [{strain_rate = 0.2}, {strain_rate = 0.3}]\n" + minimal);
  EXPECT_EQ(strain_rates(input), (Reals{0.2, 0.3}));
}

TEST_F(InputTest, MistakesInPointTablesAreRefused) {
  EXPECT_EQ(refusal(with_points + "step = [0.01, 0.02]\n"),
            "a.toml:19: run.step is a list, but a [[point]] table is one row and takes one number; write one table per "
            "number");
  EXPECT_EQ(refusal(with_points + "threads = 2\n"),
            "a.toml:19: [[point]] cannot hold 'threads', which is one for the whole file; write it under [run]");
  EXPECT_EQ(refusal(with_points + "title = \"x\"\n"),
            "a.toml:19: [[point]] cannot hold 'title', which is one for the whole file; write it before the first "
            "section");
  EXPECT_EQ(refusal(with_points + "durration = 2\n"),
            "a.toml:19: [[point]] unknown key 'durration'; did you mean 'duration'?");
  EXPECT_EQ(refusal(with_points + "run.particles = 64\n"),
            "a.toml:19: [run] unknown key 'particles'; 'particles' is a key of [system]");
  EXPECT_EQ(refusal(with_points + "run.duration = 2\n"),
            "a.toml:19: 'duration' is written twice in one [[point]] table, as duration and as run.duration");
  EXPECT_EQ(refusal(with_points + "step = -1\n"), "a.toml:19: run.step = -1 must be a number above 0 and at most 0.2");
  EXPECT_EQ(refusal(with_points + "[[point]]\nduration = 3\n"),
            "a.toml:19: shear.strain_rate is missing and has no default; give it under [shear] or with --set "
            "shear.strain_rate=VALUE");
  EXPECT_EQ(refusal(minimal + "[point]\nstrain_rate = 3\n"),
            "a.toml:12: point must be written as [[point]] tables, one per row, but is a table");
  EXPECT_EQ(refusal("point = []\n" + minimal), "a.toml:1: point is an empty list of rows");
  EXPECT_EQ(refusal("point = [1]\n" + minimal),
            "a.toml:1: point must be written as [[point]] tables, one per row, but is a list");
}

TEST_F(InputTest, ARowCannotTakeAListFromASection) {
  const auto rates = with(minimal, "strain_rate = 0.5", "strain_rate = [0.1, 0.2]");
  EXPECT_EQ(
      refusal(rates + "[[point]]\nduration = 3\n"),
      "a.toml:6: shear.strain_rate is a list, and the table [[point]] at a.toml:12 has no strain_rate of its own; "
      "a table is one row and takes one number");
  EXPECT_EQ(strain_rates(read(rates + "[[point]]\nstrain_rate = 0.7\n")), (Reals{0.7}));
}

// --set -----------------------------------------------------------------------------------------------------------

TEST_F(InputTest, OverridesBeatTheFileAndTheLastOneWins) {
  const SweepInput input = read(minimal, {"run.replicas=2", "run.duration = 7 ", "run.replicas=3", "title='t'",
                                          "shear.thermostat=\"isokinetic\"", "shear.strain_rate=[1,2]"});
  EXPECT_EQ(strain_rates(input), (Reals{1.0, 2.0}));
  EXPECT_EQ(input.points[0].replicas, 3);
  EXPECT_EQ(input.points[0].duration, 7.0);
  EXPECT_EQ(input.points[0].thermostat, motion::Thermostat::isokinetic);
  EXPECT_EQ(input.title, "t");
}

TEST_F(InputTest, OverridesBeatPointTables) {
  EXPECT_EQ(durations(read(with_points, {"run.duration=50"})), (Reals{50.0, 50.0, 50.0}));
  EXPECT_PRED2(starts_with, refusal(with_points, {"run.duration=[50, 60, 70]"}),
               "--set run.duration=[50, 60, 70]: run.duration is a list, and the table [[point]] at "
               "a.toml:6 has no duration of its own");
}

TEST_F(InputTest, OverridingASweptKeyDropsThePointTables) {
  const auto text = with(with_points, "equilibration = 10", "equilibration = 10\nduration = 40");
  EXPECT_EQ(strain_rates(read(text, {"shear.strain_rate=[0.3, 0.4]"})), (Reals{0.3, 0.4}));
  EXPECT_EQ(durations(read(text, {"shear.strain_rate=0.3"})), (Reals{40.0}));
  EXPECT_EQ(read(text, {"system.particles=144", "shear.strain_rate=0.3"}).points.front().particles, 144);
  EXPECT_EQ(refusal(text, {"system.energy_per_particle=2"}),
            "a.toml: shear.strain_rate is missing and has no default; give it under [shear] or with --set "
            "shear.strain_rate=VALUE (--set system.energy_per_particle=2 dropped the [[point]] tables)");
  EXPECT_EQ(refusal(with_points, {"shear.strain_rate=0.3"}),
            "a.toml: run.duration is missing and has no default; give it under [run] or with --set run.duration=VALUE "
            "(--set shear.strain_rate=0.3 dropped the [[point]] tables)");
}

TEST_F(InputTest, MistakesInOverridesNameTheOverride) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"run.durration=5", "--set run.durration=5: [run] unknown key 'durration'; did you mean 'duration'?"},
      {"duration=5", "--set duration=5: unknown key 'duration'; 'duration' is a key of [run]"},
      {"runn.step=1", "--set runn.step=1: unknown section [runn]; did you mean [run]?"},
      {"shear.thermostat=isokinetic",
       "--set shear.thermostat=isokinetic: isokinetic is not a TOML value; text needs quotes, as in --set "
       "'shear.thermostat=\"isokinetic\"'"},
      {"run.step=fast", "--set run.step=fast: run.step = fast must be a number above 0 and at most 0.2"},
      {"run.rescale=True", "--set run.rescale=True: True is not a TOML value; did you mean true?"},
      {"run.step=-0.1", "--set run.step=-0.1: run.step = -0.1 must be a number above 0 and at most 0.2"},
      {"run.step", "--set run.step: expected section.key=value, such as --set run.replicas=4"},
      {"=3", "--set =3: expected section.key=value, such as --set run.replicas=4"},
      {"run.=3", "--set run.=3: expected section.key=value, such as --set run.replicas=4"},
      {"", "--set : expected section.key=value, such as --set run.replicas=4"},
      {"run.step=", "--set run.step=: has no value; expected --set run.step=VALUE"},
      {"run.step=0.1\nrun.seed=3", "--set run.step=0.1 run.seed=3: sets more than one key; repeat --set"},
      {"point.duration=3",
       "--set point.duration=3: [[point]] tables cannot be set; set section.key=value, which holds for every row"},
      {"run=3", "--set run=3: unknown key 'run'; 'run' is a section"},
  };
  for (const auto& [text, message] : mistakes) EXPECT_EQ(refusal(minimal, {text}), message);
  EXPECT_PRED2(starts_with, refusal(minimal, {"run.step=0.1 0.2"}), "--set run.step=0.1 0.2: not valid TOML, ");
  // A line feed within a word, which the TOML library puts into its own message; refusal() checks for one line.
  EXPECT_PRED2(starts_with, refusal(minimal, {"run.step=t\nseed = 2"}), "--set run.step=t seed = 2: not valid TOML, ");
}

// Refusals --------------------------------------------------------------------------------------------------------

TEST_F(InputTest, UnknownKeysAndSectionsNameTheNearest) {
  EXPECT_EQ(refusal(with(minimal, "duration", "durration")),
            "a.toml:9: [run] unknown key 'durration'; did you mean 'duration'?");
  EXPECT_EQ(refusal(with(minimal, "duration = 100", "duration = 100\ndensity = 1")),
            "a.toml:10: [run] unknown key 'density'; 'density' is a key of [system]");
  EXPECT_EQ(refusal(with(minimal, "duration = 100", "duration = 100\ndensiti = 1")),
            "a.toml:10: [run] unknown key 'densiti'; did you mean 'density' of [system]?");
  EXPECT_EQ(refusal(with(minimal, "strain_rate", "rate")),
            "a.toml:6: [shear] unknown key 'rate'; did you mean 'strain_rate'?");
  EXPECT_EQ(refusal(minimal + "[kernel]\nqqq = 1\n"),
            "a.toml:13: [kernel] unknown key 'qqq'; its keys are name, range");
  EXPECT_EQ(refusal("particles = 64\n" + minimal),
            "a.toml:1: unknown key 'particles'; 'particles' is a key of [system]");
  EXPECT_EQ(refusal("titel = 'x'\n" + minimal), "a.toml:1: unknown key 'titel'; did you mean 'title'?");
  EXPECT_EQ(refusal(with(minimal, "[shear]", "[sheer]")), "a.toml:5: unknown section [sheer]; did you mean [shear]?");
  EXPECT_EQ(refusal(with(minimal, "# end", "[zzzzzz]")),
            "a.toml:11: unknown section [zzzzzz]; the sections are system, kernel, shear, run, output");
  EXPECT_EQ(refusal(with(minimal, "# end", "[correlation]")),
            "a.toml:11: unknown section [correlation]; it belongs to an input of `lucy green-kubo`");
  EXPECT_EQ(refusal(with(minimal, "# end", "[[point]]\n[[pointe]]")),
            "a.toml:12: unknown section [pointe]; did you mean [[point]]?");
  EXPECT_EQ(refusal(minimal + "[duration]\n"), "a.toml:12: unknown section [duration]; 'duration' is a key of [run]");
  EXPECT_EQ(refusal("kernel = 3\n" + minimal),
            "a.toml:1: 'kernel' must be a section, written once as [kernel], but is a number");
  EXPECT_EQ(refusal(minimal + "[[output]]\n"),
            "a.toml:12: 'output' must be a section, written once as [output], but is an array of tables");
}

TEST_F(InputTest, RequiredKeysAreNamedWhenMissing) {
  for (const auto& [line, path] :
       std::vector<std::pair<std::string, std::string>>{{"particles = 64", "system.particles"},
                                                        {"energy_per_particle = 1", "system.energy_per_particle"},
                                                        {"strain_rate = 0.5", "shear.strain_rate"},
                                                        {"duration = 100", "run.duration"}})
    EXPECT_EQ(refusal(with(minimal, line, "")),
              fmt::format("a.toml: {} is missing and has no default; give it under [{}] or with --set {}=VALUE", path,
                          path.substr(0, path.find('.')), path));
}

TEST_F(InputTest, ValuesOutOfRangeOrOfTheWrongTypeAreRefused) {
  struct Mistake {
    std::string path, value, accepted;
  };
  const std::string above_zero = "a number above 0";
  const std::vector<Mistake> mistakes = {
      {"system.particles", "3", "an integer from 4 to 100000000"},
      {"system.particles", "-64", "an integer from 4 to 100000000"},
      {"system.particles", "64.0", "an integer from 4 to 100000000"},
      {"system.particles", "\"64\"", "an integer from 4 to 100000000"},
      {"system.particles", "true", "an integer from 4 to 100000000"},
      {"system.energy_per_particle", "nan", above_zero},
      {"system.energy_per_particle", "0", above_zero},
      {"system.density", "0", above_zero},
      {"system.density", "-1.5", above_zero},
      {"system.density", "inf", "a finite number above 0"},
      {"system.dimension", "3", "2, the only one accepted so far"},
      {"system.reading", "\"sph\"", "one of \"md\", \"spam\""},
      {"system.kinetic_temperature", "0", above_zero},
      {"kernel.name", "\"monaghan\"", "\"lucy\", the only one accepted so far"},
      {"kernel.range", "0.0", above_zero},
      {"shear.strain_rate", "nan", "a finite number"},
      {"shear.strain_rate", "-inf", "a finite number"},
      {"shear.strain_rate", "\"0.1\"", "a finite number"},
      {"shear.thermostat", "\"gauss\"", "one of \"isoenergetic\", \"isokinetic\", \"nose-hoover\", \"none\""},
      {"shear.thermostat", "1", "one of \"isoenergetic\", \"isokinetic\", \"nose-hoover\", \"none\""},
      {"shear.relaxation_time", "0", above_zero},
      {"run.integrator", "\"euler\"", "one of \"rk4\", \"velocity-verlet\""},
      {"run.step", "-0.1", "a number above 0 and at most 0.2"},
      {"run.step", "0", "a number above 0 and at most 0.2"},
      {"run.step", "0.21", "a number above 0 and at most 0.2"},
      {"run.step", "nan", "a number above 0 and at most 0.2"},
      {"run.step", "true", "a number above 0 and at most 0.2"},
      {"run.equilibration", "-1", "a number of at least 0"},
      {"run.duration", "0", above_zero},
      {"run.duration", "inf", "a finite number above 0"},
      {"run.replicas", "0", "an integer from 1 to 10000"},
      {"run.replicas", "10001", "an integer from 1 to 10000"},
      {"run.replicas", "2.5", "an integer from 1 to 10000"},
      {"run.seed", "-1", "an integer of at least 0"},
      {"run.threads", "-1", "an integer from 0 to 1024"},
      {"run.threads", "1025", "an integer from 0 to 1024"},
      {"run.target_relative_error", "0", "a number above 0 and below 1"},
      {"run.target_relative_error", "1", "a number above 0 and below 1"},
      {"run.maximum_duration", "0", above_zero},
      {"run.rescale", "1", "true or false"},
      {"run.energy_tolerance", "0", above_zero},
      {"run.checkpoint_interval", "0", above_zero},
      {"output.sample_interval", "0", above_zero},
      {"output.frame_interval", "-1", "a number of at least 0"},
  };
  for (const auto& [path, value, accepted] : mistakes) {
    const std::string section = path.substr(0, path.find('.'));
    const std::string name = path.substr(path.find('.') + 1);
    // In a file: the key stands alone in its section, at line 2.
    EXPECT_EQ(refusal(fmt::format("[{}]\n{} = {}\n", section, name, value)),
              fmt::format("a.toml:2: {} = {} must be {}", path, value, accepted));
    EXPECT_EQ(refusal(minimal, {fmt::format("{}={}", path, value)}),
              fmt::format("--set {}={}: {} = {} must be {}", path, value, path, value, accepted));
  }
  EXPECT_EQ(refusal("title = 3\n" + minimal), "a.toml:1: title = 3 must be text in quotes, on one line");
  EXPECT_PRED2(starts_with, refusal("title = \"a\\nb\"\n" + minimal), "a.toml:1: title = ");
  EXPECT_EQ(refusal(with(minimal, "= 100", "= 1979-05-27")),
            "a.toml:9: run.duration must be a number above 0, or a list of such numbers, but is a date or time");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 100", "= 9223372036854775808")), "a.toml:9: not valid TOML, ");
  EXPECT_PRED2(contains, refusal(minimal, {"run.seed=9223372036854775808"}), "not representable in 64 bits");
}

TEST_F(InputTest, WhatIsNotTomlIsRefusedWithItsLine) {
  EXPECT_EQ(refusal(with(minimal, "duration = 100", "duration = 100\nduration = 200")),
            "a.toml:10: 'duration' is written twice");
  EXPECT_EQ(refusal(minimal + "[run]\n"), "a.toml:12: 'run' is written twice");
  EXPECT_EQ(refusal(with(minimal, "= 0.5", "= 0.5\nthermostat = isokinetic")),
            "a.toml:7: isokinetic is not a TOML value; text needs quotes, as in thermostat = \"isokinetic\"");
  EXPECT_EQ(refusal(with(minimal, "= 100", "= long # very")), "a.toml:9: run.duration = long must be a number above 0");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 100", "= ")), "a.toml:9: not valid TOML, ");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "[run]", "[run")), "a.toml:8: not valid TOML, ");
}

TEST_F(InputTest, WhatIsNoTextFileIsRefused) {
  EXPECT_EQ(refusal_of(folder_ / "none.toml"),
            "none.toml: cannot be opened (No such file or directory), where a TOML file is expected");
  std::filesystem::create_directory(folder_ / "d");
  EXPECT_EQ(refusal_of(folder_ / "d"), "d: is a directory, where a TOML file is expected");
  EXPECT_EQ(refusal(std::string("\x89HDF\r\n\x1a\n\0\0", 10)),
            "a.toml: is a binary file, where a TOML file is expected");
  EXPECT_EQ(refusal(minimal + "# caf\xe9\n"), "a.toml:12: is not UTF-8 text, where a TOML file is expected");
  EXPECT_EQ(refusal("title = \"caf\xc3\xa9\"\n" + minimal), "accepted");
  EXPECT_EQ(refusal(std::string((4u << 20) + 1, ' ')), "a.toml: is larger than 4 MiB, too large for a TOML input file");
  EXPECT_PRED2(starts_with, refusal(""), "a.toml: system.particles is missing");
}

TEST_F(InputTest, SectionsAndKeysOfRowsAreKnownHoweverTheyAreWritten) {
  using Names = std::set<std::string>;
  const auto sections = [&](const std::string& text) { return outline_of(write(text), "point").sections; };
  for (const char* text : {"[correlation]\n", "[ correlation ]  # times\nlength = 1\n", "correlation.length = 1\n",
                           "correlation = {length = 1}\n"})
    EXPECT_EQ(sections(text), Names{"correlation"}) << text;
  EXPECT_EQ(sections("title = \"\"\"\n[correlation]\n\"\"\"\n[run]\n"), Names{"run"});
  for (const std::string& text :
       {std::string("correlation = 1\n"), std::string("[correlation\n"), std::string(3, '\0')})
    EXPECT_TRUE(sections(text).empty()) << text;
  EXPECT_TRUE(outline_of(folder_ / "none.toml", "point").sections.empty());
  EXPECT_EQ(outline_of(write(with_points), "point").row_keys,
            (Names{"duration", "equilibration", "particles", "run", "shear", "strain_rate", "thermostat"}));
}

TEST_F(InputTest, WhatCannotBeRunIsRefusedAtTheLineOfItsKey) {
  // 16 particles at unit density: a box of 4, below twice the range of 3.
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 64", "= 16")), "a.toml:");
  EXPECT_PRED2(contains, refusal(with(minimal, "= 64", "= 16")), "16");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "energy_per_particle = 1", "energy_per_particle = 0.4")),
               "a.toml:3: system.energy_per_particle = 0.4");
  EXPECT_PRED2(starts_with, refusal(with_points + "energy_per_particle = 0.4\n"),
               "a.toml:19: system.energy_per_particle = 0.4");
  EXPECT_PRED2(starts_with, refusal(minimal, {"system.energy_per_particle=[1, 0.4]"}),
               "--set system.energy_per_particle=[1, 0.4]: system.energy_per_particle = 0.4");
  EXPECT_EQ(refusal(minimal, {"run.maximum_duration=10"}),
            "--set run.maximum_duration=10: run.maximum_duration = 10.0 must be a number of at least run.duration = "
            "100.0");
}

TEST_F(InputTest, ARefusalOfADefaultIsPlacedAtTheTableOrTheFile) {
  const Schema schema = sweep_schema();
  const Document document = read_document(write(with_points), {}, schema);
  const auto rows = expand_rows(document, schema);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_PRED2(ends_with, locate_refusal("run.step = 0.05 is wrong with run.duration", rows[1], document, schema),
               "a.toml:9: run.step = 0.05 is wrong with run.duration");
  EXPECT_PRED2(contains, locate_refusal("run.duration = 200 is wrong", rows[1], document, schema), "a.toml:11: ");
  EXPECT_PRED2(contains, locate_refusal("all is wrong", rows[2], document, schema), "a.toml:14: ");
}

// The resolved input ----------------------------------------------------------------------------------------------

TEST_F(InputTest, TheResolvedTextGivesBackTheSamePoints) {
  const auto lists = with(with(minimal, "energy_per_particle = 1", "energy_per_particle = [0.5, 0.1e1]"),
                          "strain_rate = 0.5", "strain_rate = [0.1, 0.30000000000000004]");
  for (const std::string& text :
       {minimal, lists, with_points,
        with_points + "[[point]]\nstrain_rate = 1\nduration = 300\nmaximum_duration = 400\n",
        minimal + "[[point]]\n[[point]]\n", "title = \"a \\\"b\\\" \\\\ caf\xc3\xa9\"\n" + minimal}) {
    const SweepInput input = read(text);
    const std::string resolved = resolved_toml(input);
    const SweepInput again = read(resolved);
    EXPECT_EQ(fingerprint(again), fingerprint(input)) << resolved;
    EXPECT_EQ(resolved_toml(again), resolved);
  }
}

TEST_F(InputTest, TheResolvedTextKeepsEveryBitOfRandomNumbers) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> exponent(-12, 12);
  SweepInput input = read(minimal);
  for (int i = 0; i < 300; ++i) {
    cases::CouettePoint point = input.points.front();
    point.strain_rate = (i % 2 == 0 ? 1e-12 : -1e-12) * std::pow(10.0, exponent(generator));
    point.duration = std::pow(10.0, exponent(generator));
    point.energy_tolerance = std::pow(10.0, exponent(generator));
    point.seed = generator() >> 1;
    if (i % 3 == 0) point.kinetic_temperature = std::pow(10.0, exponent(generator));
    if (i % 5 == 0) point.target_relative_error = 0.5 + 0.49 * exponent(generator) / 12;
    input.points.push_back(point);
  }
  EXPECT_EQ(fingerprint(read(resolved_toml(input))), fingerprint(input));
}

TEST_F(InputTest, TheResolvedTextLeavesOutWhatChangesNoResult) {
  const std::string text = resolved_toml(read(minimal));
  EXPECT_EQ(resolved_toml(read(minimal, {"run.threads=7", "run.checkpoint_interval=1"})), text);
  EXPECT_PRED2(lacks, text, "threads");
  EXPECT_NE(resolved_toml(read(minimal, {"run.seed=2"})), text);
  EXPECT_PRED2(lacks, text, "[[point]]");
}

TEST_F(InputTest, TheResolvedTextSharesWhatAllRowsShare) {
  const std::string text = resolved_toml(read(with_points));
  EXPECT_PRED2(contains, text,
               "[[point]]\nparticles = 64\nstrain_rate = 0.1\nthermostat = \"isoenergetic\"\n"
               "equilibration = 10.0\nduration = 1000.0\n");
  EXPECT_PRED2(contains, text, "[system]\nenergy_per_particle = 1.0\ndensity = 1.0\n");
}

// Explanation -----------------------------------------------------------------------------------------------------

TEST(Explain, TakesASectionOrAKey) {
  EXPECT_PRED2(starts_with, explain(sweep_schema(), "run.step"), "[run]\n  step\n");
  EXPECT_PRED2(contains, explain(sweep_schema(), "run.step"), "Default: 0.05.");
  EXPECT_PRED2(contains, explain(sweep_schema(), "run.step"), "Accepted: a number above 0 and at most 0.2, or a list");
  EXPECT_EQ(explain(sweep_schema(), "step"), explain(sweep_schema(), "run.step"));
  EXPECT_PRED2(contains, explain(sweep_schema(), "shear"), "strain_rate");
  EXPECT_PRED2(contains, explain(sweep_schema(), "shear"), "thermostat");
  EXPECT_PRED2(lacks, explain(sweep_schema(), "shear"), "seed");
  EXPECT_EQ(explain(sweep_schema(), "[shear]"), explain(sweep_schema(), "shear"));
  EXPECT_PRED2(starts_with, explain(sweep_schema(), "point"), "[[point]]\n");
  EXPECT_PRED2(contains, explain(sweep_schema(), "title"), "title");
}

TEST(Explain, RefusesWhatIsNotThereWithTheNearest) {
  const auto message = [](std::string_view filter) -> std::string {
    try {
      return explain(sweep_schema(), filter);
    } catch (const BadInput& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("shaer"), "no section or key 'shaer'; did you mean 'shear'?");
  EXPECT_EQ(message("run.stpe"), "no section or key 'run.stpe'; did you mean 'run.step'?");
  EXPECT_EQ(message("durration"), "no section or key 'durration'; did you mean 'duration'?");
  EXPECT_EQ(message("zzzzzzzz"),
            "no section or key 'zzzzzzzz'; the sections are system, kernel, shear, run, output, point");
}

// Schema ----------------------------------------------------------------------------------------------------------

TEST(Schema, RealsAreWrittenAsAPersonWouldAndReadBack) {
  EXPECT_EQ(toml_text(0.00451), "0.00451");
  EXPECT_EQ(toml_text(1.0), "1.0");
  EXPECT_EQ(toml_text(1e-5), "1e-5");
  EXPECT_EQ(toml_text(-2.5e-10), "-2.5e-10");
  EXPECT_EQ(toml_text(1e300), "1e300");
  EXPECT_EQ(toml_text(28000.0), "28000.0");
  EXPECT_EQ(toml_text(std::string("a\"\\\t")), "\"a\\\"\\\\\\u0009\"");
}

// Shipped inputs --------------------------------------------------------------------------------------------------

TEST(ShippedInputs, QuickHasScalarsInRunAndNoPointTables) {
  const Document document = read_document(shipped / "quick.toml", {}, sweep_schema());
  EXPECT_TRUE(document.rows.empty());
  EXPECT_FALSE(document.shared.contains("run.target_relative_error"));
  for (const auto& [path, entry] : document.shared) EXPECT_FALSE(path.starts_with("run.") && entry.is_list) << path;

  const SweepInput input = read_sweep(shipped / "quick.toml");
  EXPECT_EQ(strain_rates(input), (Reals{0.05, 0.1, 0.2, 0.5, 1.0}));
  double seconds = 0;  // on two cores at 40 ns per particle and stage
  for (const auto& point : input.points)
    seconds += point.replicas * (point.equilibration + point.duration) / point.step * 4 *
               static_cast<double>(point.particles) * 40e-9 / 2;
  EXPECT_LT(seconds, 60.0);
}

struct PublishedRow {
  std::int64_t particles;
  double run_length;
  double strain_rate;
};

std::vector<PublishedRow> published_rows(int table) {
  std::ifstream file(std::filesystem::path(LUCY_SOURCE_DIRECTORY) /
                     fmt::format("reference/posch1995_table{}.csv", table));
  std::vector<PublishedRow> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    rows.push_back({std::stoll(values.at(0)), std::stod(values.at(1)), std::stod(values.at(2))});
  }
  return rows;
}

TEST(ShippedInputs, BothPublishedTablesAreThereRowByRow) {
  for (const int table : {1, 2}) {
    const auto rows = published_rows(table);
    ASSERT_EQ(rows.size(), 15u);
    const SweepInput input = read_sweep(shipped / fmt::format("posch1995_table{}.toml", table));
    ASSERT_EQ(input.points.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& point = input.points[i];
      EXPECT_EQ(point.particles, rows[i].particles);
      EXPECT_EQ(point.strain_rate, rows[i].strain_rate);
      EXPECT_EQ(point.energy_per_particle, table == 1 ? 0.5 : 1.0);
      EXPECT_EQ(point.replicas, 2);
      EXPECT_GE(point.duration, (1 - 1e-9) * rows[i].run_length / rows[i].strain_rate) << "row " << i + 1;
      EXPECT_GE(point.duration, 2000.0) << "row " << i + 1;
    }
  }
}

TEST(ShippedInputs, ThePublishedTablesCanBeChangedFromTheCommandLine) {
  const auto path = shipped / "posch1995_table2.toml";
  EXPECT_EQ(read_sweep(path, Overrides{"run.step=0.005"}).points.at(14).step, 0.005);
  EXPECT_EQ(strain_rates(read_sweep(path, Overrides{"shear.strain_rate=[0.3, 0.4]"})), (Reals{0.3, 0.4}));
  EXPECT_EQ(read_sweep(path, Overrides{"system.particles=100"}).points.size(), 13u);
}

/// A state of the system of `minimal`, in a file of that name.
class StartTest : public InputTest {
 protected:
  std::string with_start(const std::string& name, double rate_of_flow, const std::string& more = "") {
    cases::CouettePoint point;
    point.particles = 64;
    point.energy_per_particle = 1.0;
    point.duration = 100.0;
    point.seed = 3;
    testing::put(folder_ / name,
                 particle_text(format_of_name(name), cases::CouetteRun(point, 0).frame(), rate_of_flow, ""));
    return with(minimal, "energy_per_particle = 1\n",
                fmt::format("energy_per_particle = 1\nstart = \"{}\"\n{}", (folder_ / name).string(), more));
  }
};

TEST_F(StartTest, TheStateIsPartOfTheResolvedInput) {
  const SweepInput input = read(with_start("s.data", 0.0));
  const std::string resolved = resolved_toml(input);
  EXPECT_TRUE(contains(resolved, "start_checksum = \"CRC-64 ")) << resolved;
  EXPECT_EQ(resolved_toml(read(resolved)), resolved);
  // The same state in another format is the same state, but for the name of its file.
  EXPECT_EQ(read(with_start("s.xyz", 0.0)).points[0].start_checksum, input.points[0].start_checksum);
  // Another state under the same name is another input.
  std::string data = testing::contents(folder_ / "s.data");
  testing::put(folder_ / "s.data", with(data, "\n7 1 ", "\n70 1 "));
  EXPECT_TRUE(contains(refusal(resolved), "s.data")) << refusal(resolved);
  testing::put(folder_ / "s.data", with(with(data, "\n7 1 ", "\nx 1 "), "\n8 1 ", "\n7 1 "));
  testing::put(folder_ / "s.data", with(testing::contents(folder_ / "s.data"), "\nx 1 ", "\n8 1 "));
  EXPECT_TRUE(contains(refusal(resolved), "system.start_checksum = \"CRC-64 ")) << refusal(resolved);
  EXPECT_NE(read(resolved, {"system.start_checksum=\"\""}).points[0].start_checksum, input.points[0].start_checksum);
}

TEST_F(StartTest, AFlowThatIsNotSpokenOfIsRefused) {
  const std::string text = with_start("s.dump", 0.5);
  EXPECT_TRUE(contains(refusal(text), "has a flow in its velocities")) << refusal(text);
  EXPECT_TRUE(contains(refusal(text), "system.start_strain_rate"));
  EXPECT_EQ(read(text, {"system.start_strain_rate=0.5"}).points.size(), 1U);
  EXPECT_FALSE(contains(refusal(text, {"system.start_strain_rate=0"}), "has a flow"));
}

TEST_F(StartTest, ARunThatIsDoneIsReadWithoutItsStart) {
  const SweepInput input = read(with_start("s.data", 0.0));
  const auto path = write(resolved_toml(input));
  std::filesystem::remove(folder_ / "s.data");
  EXPECT_TRUE(contains(refusal_of(path), "s.data"));
  const SweepInput again = read_sweep_without_starts(path);
  EXPECT_EQ(again.points[0].start_frame, nullptr);
  EXPECT_EQ(resolved_toml(again), resolved_toml(input));
}

}  // namespace
}  // namespace lucy::files

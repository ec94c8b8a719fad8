// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What holds for the input files of all commands, and whose input a file is. The machinery behind it is tested in full
// with the input of a sweep (input_test.cpp).
#include "lucy/files/all_inputs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "input_folder.hpp"
#include "lucy/files/benard_grid_input.hpp"
#include "lucy/files/benard_input.hpp"
#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/isomorphism_input.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/wave_input.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using testing::lacks;
using testing::Overrides;
using testing::starts_with;
using testing::with;

const std::filesystem::path shipped = std::filesystem::path(LUCY_SOURCE_DIRECTORY) / "inputs";

/// Reads a file as an input of `kind`; the resolved text of what was read.
std::string resolved(InputKind kind, const std::filesystem::path& file, const Overrides& overrides = {}) {
  switch (kind) {
    case InputKind::sweep:
      return resolved_toml(read_sweep(file, overrides));
    case InputKind::green_kubo:
      return green_kubo_resolved_toml(read_green_kubo(file, overrides));
    case InputKind::isomorphism:
      return isomorphism_resolved_toml(read_isomorphism(file, overrides));
    case InputKind::shear_flow:
      return shear_flow_resolved_toml(read_shear_flow(file, overrides));
    case InputKind::shear_wave:
      return wave_resolved_toml(read_wave(cases::WaveQuantity::shear, file, overrides));
    case InputKind::benard:
      return benard_resolved_toml(read_benard(file, overrides));
    case InputKind::benard_grid:
      return benard_grid_resolved_toml(read_benard_grid(file, overrides));
    case InputKind::temperature_wave:
      break;
  }
  return wave_resolved_toml(read_wave(cases::WaveQuantity::temperature, file, overrides));
}

using Command = std::pair<std::string_view, InputKind>;

class EveryInput : public testing::InputFolder, public ::testing::WithParamInterface<Command> {
 protected:
  InputKind kind() const { return GetParam().second; }
  Schema schema() const { return schema_of(kind()); }

  /// Has what the command requires, [run] in the end.
  std::string minimal() const {
    if (kind() == InputKind::benard_grid) return "[fluid]\nrayleigh = 5000\n[grid]\ncells = 8\n[run]\nduration = 100\n";
    if (kind() == InputKind::benard)
      return "[system]\nparticles = 200\n[fluid]\nrayleigh = 5000\n[run]\nduration = 100\n";
    std::string text = "[system]\nparticles = 144\n";
    const Schema known = schema();
    if (const Key* key = known.find("system.energy_per_particle"); key != nullptr && key->required)
      text += "energy_per_particle = 1\n";
    if (known.find("shear.strain_rate") != nullptr) text += "[shear]\nstrain_rate = 0.5\n";
    return text + "[run]\nduration = 100\n";
  }
  /// A continuum is not.
  bool random() const { return schema().find("run.seed") != nullptr; }
  std::string refusal(const std::string& text, const Overrides& overrides = {}) const {
    return refusal_from([&] { resolved(kind(), write(text), overrides); });
  }
};

INSTANTIATE_TEST_SUITE_P(AllCommands, EveryInput, ::testing::ValuesIn(command_names),
                         [](const ::testing::TestParamInfo<Command>& command) {
                           std::string name(command.param.first);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(EveryInput, NeedsOnlyTheKeysThatHaveNoDefault) {
  EXPECT_EQ(refusal(minimal()), "accepted");
  for (const Key& key : schema().keys) {
    if (!key.required) continue;
    EXPECT_PRED2(starts_with, refusal(with(minimal(), key.name + " = ", key.name == "duration" ? "seed = " : "#")),
                 fmt::format("a.toml: {} is missing and has no default; give it under [{}] or with --set {}=VALUE",
                             key.path(), key.section, key.path()));
  }
}

TEST_P(EveryInput, RefusesMistakesWithTheirPlace) {
  EXPECT_PRED2(contains, refusal(with(minimal(), "duration", "durration")),
               "[run] unknown key 'durration'; did you mean 'duration'?");
  EXPECT_PRED2(contains, refusal(minimal() + "[runn]\n"), "unknown section [runn]; did you mean [run]?");
  EXPECT_EQ(refusal("titel = 'x'\n" + minimal()), "a.toml:1: unknown key 'titel'; did you mean 'title'?");
  EXPECT_PRED2(contains, refusal(minimal() + "[[point]]\ndurration = 2\n"),
               "[[point]] unknown key 'durration'; did you mean 'duration'?");
  if (random()) {
    EXPECT_PRED2(contains, refusal(minimal() + "seed = \"seven\"\n"), "run.seed = \"seven\" must be an integer");
    EXPECT_PRED2(contains, refusal(minimal() + "equilibration = nan\n"), "run.equilibration = nan must be a number");
    EXPECT_PRED2(contains, refusal(minimal() + "replicas = [1, 2]\n"), "run.replicas must be an integer");
  }
  EXPECT_EQ(refusal(minimal(), {"run.step=-0.1"}).find("--set run.step=-0.1: run.step = -0.1 must be a number above 0"),
            0u);
  EXPECT_EQ(refusal_from([&] { resolved(kind(), folder_ / "none.toml"); }),
            "none.toml: cannot be opened (No such file or directory), where a TOML file is expected");
}

TEST_P(EveryInput, NamesTheCommandsThatHaveASectionOrAKeyThatItLacks) {
  const auto has_section = [](const Schema& schema, const std::string& section) {
    return std::ranges::find(schema.sections, section, &Section::name) != schema.sections.end();
  };
  for (const auto& [command, other] : command_names) {
    for (const Key& key : schema_of(other).keys) {
      const std::string belongs = "belongs to an input of ";
      const std::string named = fmt::format("`lucy {}`", command);
      const Overrides setting = {key.path() + "=1"};
      if (!has_section(schema(), key.section)) {
        const std::string message = refusal(fmt::format("{}[{}]\n", minimal(), key.section));
        EXPECT_PRED2(contains, message, fmt::format("unknown section [{}]; ", key.section));
        EXPECT_PRED2(contains, message, belongs);
        EXPECT_PRED2(contains, message, named);
        EXPECT_PRED2(contains, refusal(minimal(), setting), named);
      } else if (schema().find(key.path()) == nullptr) {
        const std::string message = refusal(minimal(), setting);
        EXPECT_PRED2(contains, message, fmt::format("[{}] unknown key '{}'; it {}", key.section, key.name, belongs));
        EXPECT_PRED2(contains, message, named);
        EXPECT_PRED2(contains, refusal(fmt::format("{}[[point]]\n{} = 1\n", minimal(), key.name)), named);
      }
    }
  }
}

TEST_P(EveryInput, IsChangedByOverridesAlsoInPointTables) {
  const auto file = write(minimal() + "[[point]]\nduration = 20\n[[point]]\nduration = 30\n");
  EXPECT_EQ(resolved(kind(), file, {"run.duration=50", "run.duration=40"}),
            resolved(kind(), write(with(minimal(), "100", "40") + "[[point]]\n[[point]]\n")));
}

TEST_P(EveryInput, ResolvedIsReadBackAsItIs) {
  const std::string other = random() ? "seed = 5\n" : "step = 0.5\n";
  for (const std::string& text :
       {minimal(), minimal() + "[[point]]\nduration = 0.30000000000000004e2\n[[point]]\n" + other}) {
    const std::string once = resolved(kind(), write(text), {"run.threads=7", "run.checkpoint_interval=1"});
    EXPECT_EQ(resolved(kind(), write(once)), once);
    EXPECT_PRED2(lacks, once, "threads");
    EXPECT_PRED2(lacks, once, "checkpoint_interval");
  }
}

TEST_P(EveryInput, HasKeysWithUniqueNamesMeaningsAndDefaultsWithinTheirRange) {
  std::set<std::string> names;
  for (const Key& key : schema().keys) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.meaning.empty()) << key.path();
    if (key.required || !key.default_value) continue;
    EXPECT_EQ(checked_value(key, *key.default_value, {}), *key.default_value) << key.path();
  }
}

TEST_P(EveryInput, IsExplainedKeyByKeyInNarrowLines) {
  const std::string text = explain(schema());
  EXPECT_PRED2(contains, text, fmt::format("`lucy {}`", GetParam().first));
  EXPECT_LE(testing::widest_line(text), 100u);
  for (const Key& key : schema().keys) {
    EXPECT_PRED2(contains, text, "\n  " + key.name + "\n");
    const std::string alone = explain(schema(), key.path());
    for (const char* part : {"Unit: ", "Default: ", "Accepted: "}) EXPECT_PRED2(contains, alone, part);
  }
}

// Whose input a file is --------------------------------------------------------------------------------------------

class KindOfInput : public testing::InputFolder {
 protected:
  InputKind kind(const std::string& text, const Overrides& overrides = {}) const {
    return kind_of_input(write(text), overrides);
  }
};

TEST_F(KindOfInput, IsKnownOfTheShippedFiles) {
  const std::vector<std::pair<const char*, InputKind>> files = {{"quick.toml", InputKind::sweep},
                                                                {"posch1995_table1.toml", InputKind::sweep},
                                                                {"posch1995_table2.toml", InputKind::sweep},
                                                                {"posch1995_green_kubo.toml", InputKind::green_kubo},
                                                                {"isomorphism.toml", InputKind::isomorphism},
                                                                {"shear_flow.toml", InputKind::shear_flow},
                                                                {"shear_wave.toml", InputKind::shear_wave},
                                                                {"benard_quick.toml", InputKind::benard},
                                                                {"benard_800.toml", InputKind::benard},
                                                                {"benard_walls.toml", InputKind::benard},
                                                                {"benard_grid.toml", InputKind::benard_grid},
                                                                {"benard_critical.toml", InputKind::benard_grid}};
  for (const auto& [file, kind] : files) EXPECT_EQ(kind_of_input(shipped / file), kind) << file;
}

TEST_F(KindOfInput, FollowsFromSectionsPointTablesAndOverrides) {
  EXPECT_EQ(kind("[system]\n[shear]\n"), InputKind::sweep);
  EXPECT_EQ(kind("[system]\n[[point]]\nstrain_rate = 1\n"), InputKind::sweep);
  EXPECT_EQ(kind("[system]\n", {"shear.strain_rate=1"}), InputKind::sweep);
  EXPECT_EQ(kind("[system]\n"), InputKind::green_kubo);
  EXPECT_EQ(kind("[ correlation ]  # times\nlength = 1\n"), InputKind::green_kubo);
  EXPECT_EQ(kind("[shear]\n[isentropic]\n"), InputKind::isomorphism);
  EXPECT_EQ(kind("[shear]\nstrain_rate = 1\n", {"isentropic.pressure=2"}), InputKind::isomorphism);
  EXPECT_EQ(kind("[fluid]\n[[point]]\nshear.strain_rate = 1\n"), InputKind::shear_flow);
  EXPECT_EQ(kind("[shear]\n[start]\n"), InputKind::shear_flow);
  EXPECT_EQ(kind("[fluid]\n[grid]\n"), InputKind::benard_grid);
  EXPECT_EQ(kind("[fluid]\n", {"cell.side=1"}), InputKind::benard_grid);
  EXPECT_EQ(kind("[cell]\n[system]\n"), InputKind::benard);
  EXPECT_EQ(kind("[cell]\n", {"system.particles=8"}), InputKind::benard);
  EXPECT_EQ(kind("[cell]\n[[point]]\nparticles = 8\n"), InputKind::benard);
  EXPECT_EQ(kind("[fluid]\n[[point]]\nparticles = 8\nwall = \"mirror-images\"\n"), InputKind::benard);
  EXPECT_EQ(kind_of_input(folder_ / "none.toml"), InputKind::green_kubo);  // which is to tell why
}

TEST_F(KindOfInput, OfAWaveIsThatOfTheOnlyCommandThatAcceptsIt) {
  const std::string wave = "[system]\nparticles = 144\n[run]\nduration = 100\n[wave]\n";
  EXPECT_EQ(kind(wave + "[[point]]\nreading = \"md\"\nenergy_per_particle = 1\n"), InputKind::shear_wave);
  EXPECT_EQ(kind(wave + "[fluid]\nequation_of_state = \"dense-fluid\"\n"), InputKind::shear_wave);
  const std::string both =
      "a.toml: is an input both of `lucy shear-wave` and of `lucy temperature-wave`; say which with --for shear-wave "
      "or --for temperature-wave";
  EXPECT_EQ(refusal_from([&] { kind(wave); }), both);
  EXPECT_EQ(refusal_from([&] { kind(with(wave, "[wave]", "[fluid]") + "conductivity = 1\n"); }), both);
  EXPECT_EQ(refusal_from([&] { kind(wave + "lenght = 3\n"); }).find("a.toml:6: [wave] unknown key 'lenght'"), 0u);
}

}  // namespace
}  // namespace lucy::files

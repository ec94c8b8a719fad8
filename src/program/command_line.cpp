// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/build_record.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/schema.hpp"
#include "program/commands.hpp"

namespace lucy::program {

namespace {

constexpr int done = 0;
constexpr int failed = 1;
constexpr int bad_usage = 2;

constexpr std::string_view output_refused = "cannot write to standard output";

constexpr std::string_view short_help =
    "Usage: lucy COMMAND ...\n"
    "\n"
    "  lucy sweep INPUT [--out DIR] [--set key=value]...   run a table of shear viscosities\n"
    "  lucy green-kubo INPUT [--out DIR] [--set ...]...    viscosities from equilibrium fluctuations\n"
    "  lucy isomorphism INPUT [--out DIR] [--set ...]...   atoms and smooth particles compared bit by bit\n"
    "  lucy shear-flow INPUT [--out DIR] [--set ...]...    viscous fluids of smooth particles under shear\n"
    "  lucy shear-wave INPUT [--out DIR] [--set ...]...    decaying waves: what viscosity particles have, and why\n"
    "  lucy temperature-wave INPUT [--out DIR] ...         the same of thermal diffusivity\n"
    "  lucy benard INPUT [--out DIR] [--set ...]...        convection of smooth particles between hot and cold walls\n"
    "  lucy benard-grid INPUT [--out DIR] [--set ...]...   the same of a continuum, on meshes\n"
    "  lucy check INPUT [--set key=value]...               say what any of these would do and cost\n"
    "  lucy compare TABLE --with NAME                      a table beside a published one\n"
    "  lucy viscosity SWEEP... GREEN-KUBO                  both routes and print side by side\n"
    "  lucy benard-compare DIR... [--out DIR]              convection by particles, grid and print side by side\n"
    "  lucy fields FILE.h5 [--frame N] [--out DIR]         a saved state as fields on a grid\n"
    "  lucy lammps export|run|check ...                    the same states in LAMMPS, and both engines compared\n"
    "  lucy read-dump FILE [--out FILE]                    a LAMMPS or XYZ file, read and written\n"
    "  lucy explain [KEY]                                  the keys of an input file\n"
    "\n"
    "A first one: lucy sweep inputs/quick.toml\n"
    "More: lucy --help, lucy COMMAND --help\n";

void say(std::string_view sentence) {
  std::fflush(stdout);
  std::fputs(fmt::format("lucy: {}\n", sentence).c_str(), stderr);  // where nobody listens, nothing is thrown
}

/// Whether standard output is a pipe whose reader has gone, as in `lucy explain | head -1`: it has read enough.
bool reader_has_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

std::string version_text() {
  const BuildRecord build = build_record();
  return fmt::format("lucy {}\ncommit {}\ncompiler {} ({})\nflags {}", build.version, build.commit, build.compiler,
                     build.build_type, build.flags);
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const auto* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const auto* option : command.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  const auto nearest = files::nearest_name(word, names);
  return nearest ? fmt::format("; did you mean {}?", *nearest) : "";
}

/// One sentence on what is wrong with the command line.
std::string usage_error(const CLI::App& program, const CLI::ParseError& error,
                        const std::vector<std::string>& arguments) {
  const auto chosen = program.get_subcommands();
  const CLI::App* deepest = chosen.empty() ? &program : chosen.front();
  std::string name = chosen.empty() ? "lucy" : "lucy " + deepest->get_name();
  for (auto deeper = deepest->get_subcommands(); deepest != &program && !deeper.empty();
       deeper = deepest->get_subcommands()) {
    deepest = deeper.front();
    name += " " + deepest->get_name();
  }
  const CLI::App& where = *deepest;
  const auto looks_like_option = [](std::string_view word) { return word.starts_with('-'); };
  if (chosen.empty() && !looks_like_option(arguments.front()))
    return fmt::format("there is no command '{}'{} (commands: {})", arguments.front(),
                       suggestion(arguments.front(), command_names(program)), fmt::join(command_names(program), ", "));
  // The first word that nothing accepted: an option by its looks, or one argument too many.
  const auto extras = where.remaining();
  const std::string word = chosen.empty() ? arguments.front() : extras.empty() ? "" : extras.front();
  if (looks_like_option(word)) {
    const std::string option = word.substr(0, word.find('='));
    return fmt::format("{} has no option {}{} (see {} --help)", name, option, suggestion(option, option_names(where)),
                       name);
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    return fmt::format("{} does not expect the argument '{}' (see {} --help)", name, word, name);
  std::string what = error.what();
  if (const auto end = what.find('\n'); end != std::string::npos) what.resize(end);
  return fmt::format("{} (see {} --help)", what, name);
}

/// Commands have the exit codes that the contract gives them; nothing thrown gets past here.
int tell_errors(const std::function<int()>& command) {
  try {
    const int code = command();
    if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && !reader_has_gone()) {
      say(output_refused);
      return failed;
    }
    return code;
  } catch (const BadInput& refusal) {
    say(refusal.what());
    return bad_usage;
  } catch (const RunFailed& failure) {
    say(failure.what());
    return failed;
  } catch (const std::bad_alloc&) {
    say("there is not enough memory");
    return failed;
  } catch (const std::exception& failure) {
    if (std::ferror(stdout) == 0) {
      say(failure.what());
      return failed;
    }
    if (reader_has_gone()) return done;
    say(output_refused);
    return failed;
  }
}

}  // namespace

int run_program(int argument_count, const char* const* argument_values) {
  std::signal(SIGPIPE, SIG_IGN);  // a sweep goes on when its reader goes away
  std::vector<std::string> words(argument_values, argument_values + argument_count);
  const std::vector<std::string> arguments(words.begin() + (words.empty() ? 0 : 1), words.end());
  if (arguments.empty()) {
    std::fputs(std::string(short_help).c_str(), stderr);
    return bad_usage;
  }

  CLI::App program(
      "Lucy: molecular dynamics of the Lucy fluid, out of equilibrium and at rest, and smooth particles (SPAM, SPH) by "
      "the\n"
      "same kernels. Shear viscosities with error bars, after Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995).",
      "lucy");
  program.require_subcommand(1);
  program.set_version_flag("--version", version_text(), "Version, commit, compiler and its flags");
  program.set_help_flag("-h,--help", "This text");
  program.footer(
      "\nExamples:\n"
      "  lucy sweep inputs/quick.toml\n"
      "  lucy compare runs/quick/table.csv --with posch1995_table2\n"
      "  lucy green-kubo inputs/posch1995_green_kubo.toml\n"
      "  lucy explain run\n"
      "\nExit codes: 0 done, 1 ran but failed (or a comparison disagreed), 2 bad input or usage.");

  InputRequest request;
  request.command_line = words;
  std::string out;
  std::string input;
  const auto add_input = [&](CLI::App* command, const char* results = "runs/NAME") {
    command->add_option("INPUT", input, "Input file (TOML)")->required();
    command->add_option("--set", request.overrides, "Set a key of the input file; beats the file; may be repeated")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    command
        ->add_option("--out", out, fmt::format("Directory of the results; default: {} for an input NAME.toml", results))
        ->type_name("DIR");
    command->set_help_flag("-h,--help", "This text");
  };

  auto* sweep_command = program.add_subcommand("sweep", "Run a sweep: one table of shear viscosities");
  add_input(sweep_command);
  sweep_command->footer(
      "\nThe directory may be new, empty, or hold this same sweep, which then resumes. Ctrl-C stops at the next "
      "sample; the\n"
      "same command resumes, and ends with the same bits. So it does after a crash.\n"
      "\nExamples:\n"
      "  lucy sweep inputs/quick.toml\n"
      "  lucy sweep inputs/quick.toml --set run.replicas=4 --set shear.strain_rate=[0.3,0.7] --out runs/mine\n"
      "  lucy sweep inputs/posch1995_table2.toml --set run.step=0.005 --out runs/paper_step");

  auto* green_kubo_command =
      program.add_subcommand("green-kubo", "Viscosities from the stress fluctuations at equilibrium");
  add_input(green_kubo_command);
  green_kubo_command->get_option("INPUT")->required(false);
  SeriesRequest series;
  std::string series_file;
  std::string difference;
  std::string pxx;
  std::string pyy;
  double length = 0.0;
  double cutoff = 0.0;
  bool no_pictures = false;
  green_kubo_command->add_flag("--no-pictures", no_pictures, "Do not draw");
  const auto from_series = [&](CLI::Option* option, const char* unit) {
    return option->type_name(unit)->group("Stresses that were sampled elsewhere, instead of INPUT");
  };
  auto* series_option = from_series(
      green_kubo_command->add_option("--from-series", series_file, "File of columns, one row per sample"), "FILE");
  const std::vector<CLI::Option*> series_options = {
      from_series(green_kubo_command->add_option("--interval", series.interval,
                                                 "Time between rows; must fit a column time, where there is one"),
                  "TIME"),
      from_series(green_kubo_command->add_option("--volume", series.volume, "Volume V (in two dimensions, area)"), "V"),
      from_series(green_kubo_command->add_option("--temperature", series.temperature, "kT"), "KT"),
      from_series(green_kubo_command->add_option("--pxy", series.pxy, "Column of Pxy, name or number; default: pxy"),
                  "COLUMN"),
      from_series(green_kubo_command->add_option("--pxx", pxx, "Column of Pxx; default: pxx"), "COLUMN"),
      from_series(green_kubo_command->add_option("--pyy", pyy, "Column of Pyy; default: pyy"), "COLUMN"),
      from_series(
          green_kubo_command->add_option("--difference", difference, "Column of (Pxx - Pyy)/2, instead of both"),
          "COLUMN"),
      from_series(green_kubo_command->add_option("--length", length, "Longest time that is correlated"), "TIME"),
      from_series(green_kubo_command->add_option("--cutoff", cutoff, "Cut-off of the integral; default: by the rule"),
                  "TIME")};
  green_kubo_command->footer(
      "\nInterrupted, the same command resumes and ends with the same bits.\n"
      "\nExamples:\n"
      "  lucy green-kubo inputs/posch1995_green_kubo.toml\n"
      "  lucy green-kubo inputs/posch1995_green_kubo.toml --set correlation.diffusion=true --out runs/diffusion\n"
      "  lucy green-kubo --from-series stress.dat --interval 0.2 --volume 1024 --temperature 0.539");

  auto* isomorphism_command =
      program.add_subcommand("isomorphism", "Atoms and smooth particles side by side, compared bit by bit");
  add_input(isomorphism_command);
  isomorphism_command->footer(
      "\nExit code 0: every bit is the same; 1: not, and the first difference is named. Interrupted, the same command "
      "resumes.\n"
      "\nExamples:\n"
      "  lucy isomorphism inputs/isomorphism.toml\n"
      "  lucy isomorphism inputs/isomorphism.toml --set isentropic.pressure=2 --out runs/another_fluid");

  auto* shear_flow_command =
      program.add_subcommand("shear-flow", "Viscous fluids of smooth particles under shear, in a steady state");
  add_input(shear_flow_command);
  shear_flow_command->footer(
      "\nInterrupted, the same command resumes.\n"
      "\nExamples:\n"
      "  lucy shear-flow inputs/shear_flow.toml\n"
      "  lucy shear-flow inputs/shear_flow.toml --set shear.strain_rate=[0.05,0.1] --set fluid.viscosity=1 --out "
      "runs/thick");

  auto* shear_wave_command = program.add_subcommand(
      "shear-wave", "Decaying shear waves: what viscosity smooth particles and atoms have, and where it comes from");
  add_input(shear_wave_command);
  shear_wave_command->footer(
      "\nInterrupted, the same command resumes and ends with the same bits.\n"
      "\nExamples:\n"
      "  lucy shear-wave inputs/shear_wave.toml\n"
      "  lucy shear-wave inputs/shear_wave.toml --set system.particles=1024 --set fluid.viscosity=0.5 --out "
      "runs/thick");

  auto* temperature_wave_command = program.add_subcommand(
      "temperature-wave", "Decaying temperature waves: what thermal diffusivity smooth particles have");
  add_input(temperature_wave_command);
  temperature_wave_command->footer(
      "\nInterrupted, the same command resumes and ends with the same bits.\n"
      "\nExample:\n"
      "  lucy temperature-wave inputs/temperature_wave.toml");

  auto* benard_command = program.add_subcommand(
      "benard", "Convection of smooth particles between a hot floor and a cold ceiling: kinetic energies, heat flux");
  add_input(benard_command);
  benard_command->footer(
      "\nInterrupted, the same command resumes and ends with the same bits.\n"
      "\nExamples:\n"
      "  lucy benard inputs/benard_quick.toml\n"
      "  lucy benard inputs/benard_ra10000.toml --set fluid.rayleigh=20000 --out runs/ra20000");

  auto* benard_grid_command = program.add_subcommand(
      "benard-grid", "Convection of a continuum between a hot floor and a cold ceiling, extrapolated over meshes");
  add_input(benard_grid_command);
  benard_grid_command->footer(
      "\nInterrupted, the same command resumes and ends with the same bits.\n"
      "\nExamples:\n"
      "  lucy benard-grid inputs/benard_grid.toml\n"
      "  lucy benard-grid inputs/benard_critical.toml --set 'fluid.transport=\"kinematic\"' --out runs/kinematic");

  auto* check_command = program.add_subcommand("check", "Validate an input and predict its cost; run nothing");
  add_input(check_command);
  check_command->footer(
      "\nWithout --for, a file is taken for an input of the command whose sections it writes:\n"
      "  [cell], with [system]                benard\n"
      "  [cell] or [grid]                     benard-grid\n"
      "  [isentropic]                         isomorphism\n"
      "  [fluid] or [start], with [shear]     shear-flow\n"
      "  [fluid] or [start], or [wave]        shear-wave or temperature-wave, the one that accepts it; where both do,\n"
      "                                       --for is asked for\n"
      "  [shear], without [correlation]       sweep\n"
      "  anything else                        green-kubo\n"
      "\nExamples:\n"
      "  lucy check inputs/posch1995_table1.toml --set run.replicas=8\n"
      "  lucy check inputs/temperature_wave.toml --for temperature-wave");

  const std::map<std::string, files::InputKind> kinds(files::command_names.begin(), files::command_names.end());
  std::optional<files::InputKind> kind;
  const auto add_kind = [&](CLI::App* command, const char* text) {
    const auto choose = [&](const std::string& name) {
      const auto found = kinds.find(name);
      if (found == kinds.end()) {
        std::vector<std::string_view> names;
        for (const auto& [known, of] : files::command_names) names.push_back(known);
        throw CLI::ValidationError(fmt::format("--for = \"{}\" must be one of {}", name, fmt::join(names, ", ")));
      }
      kind = found->second;
    };
    command->add_option_function<std::string>("--for", choose, text)->type_name("COMMAND");
  };
  add_kind(
      check_command,
      "sweep, green-kubo, isomorphism, shear-flow, shear-wave, temperature-wave, benard or benard-grid; default: by "
      "the sections of the file, as told below");

  auto* explain_command = program.add_subcommand("explain", "Print the keys of an input file");
  std::string filter;
  add_kind(explain_command,
           "sweep (the default), green-kubo, isomorphism, shear-flow, shear-wave, temperature-wave, benard or "
           "benard-grid");
  explain_command->add_option("KEY", filter, "A section (run) or a key (run.step); default: all of them");
  explain_command->set_help_flag("-h,--help", "This text");
  explain_command->footer(
      "\nExamples:\n  lucy explain\n  lucy explain run.step\n  lucy explain --for green-kubo correlation");

  auto* compare_command = program.add_subcommand("compare", "Lay a table beside a published one");
  std::string table;
  std::string published;
  compare_command->add_option("TABLE", table, "table.csv of a sweep, or the directory that holds it")->required();
  compare_command
      ->add_option("--with", published,
                   "Name of a published table (posch1995_table1, posch1995_table2), a "
                   "CSV file, or the directory of another sweep")
      ->type_name("NAME")
      ->required();
  compare_command->set_help_flag("-h,--help", "This text");
  compare_command->footer(
      "\nExit code 0: every judged number agrees within 4 combined standard errors; 1: not; 2: bad input.\n"
      "\nExamples:\n"
      "  lucy compare runs/posch1995_table1/table.csv --with posch1995_table1\n"
      "  lucy compare runs/mine --with runs/other/table.csv");

  auto* viscosity_command = program.add_subcommand(
      "viscosity", "The viscosity by every route: a sweep at zero rate, Green-Kubo, print, weak scattering");
  std::vector<std::filesystem::path> results;
  viscosity_command
      ->add_option(
          "RESULTS", results,
          "Directory of a sweep (several may be given), or its table.csv; last the directory of a Green-Kubo run, "
          "or its viscosity.csv")
      ->type_name("SWEEP... GREEN-KUBO")
      ->required();
  viscosity_command->add_option("--out", out, "Directory of the results; default: that of the Green-Kubo run")
      ->type_name("DIR");
  viscosity_command->set_help_flag("-h,--help", "This text");
  viscosity_command->footer(
      "\nExample:\n  lucy viscosity runs/posch1995_table1 runs/posch1995_table2 runs/posch1995_green_kubo");

  auto* benard_compare_command =
      program.add_subcommand("benard-compare", "Convection by particles, on the grid and in print side by side");
  BenardCompareRequest convection;
  std::string effective;
  benard_compare_command
      ->add_option("DIRECTORY", convection.directories, "Directories of benard and benard-grid runs, in any order")
      ->required();
  benard_compare_command
      ->add_option("--published", published, "CSV file of published kinetic energies; default: the one that Lucy has")
      ->type_name("FILE");
  benard_compare_command
      ->add_option("--effective", effective, "Directory of a benard-grid run with the coefficients that particles have")
      ->type_name("DIR");
  benard_compare_command
      ->add_option("--out", out, "Directory of the results; default: the first one of particles that is given")
      ->type_name("DIR");
  benard_compare_command->set_help_flag("-h,--help", "This text");
  benard_compare_command->footer(
      "\nA flow on the grid belongs to particles of the same fluid, sides, temperatures and Rayleigh number. With\n"
      "effective coefficients it has another one: those belong to particles of the same cell in the order of Ra.\n"
      "\nExample:\n  lucy benard-compare runs/benard_ra10000 runs/benard_grid");

  auto* fields_command = program.add_subcommand("fields", "A saved state as fields on a grid, and their spectra");
  FieldsRequest fields_request;
  std::string frame;
  std::string weight;
  double frame_time = 0.0;
  double weight_range = 0.0;
  std::array<int, 2> grid{};
  fields_command->add_option("FILE", fields_request.file, "point_NNN.h5 of a run with output.frame_interval")
      ->required();
  fields_command->add_option("--replica", fields_request.replica, "Number of the replica; default: 1")->type_name("N");
  fields_command->add_option("--frame", frame, "Number of the frame, from 1, or all; default: the last")
      ->type_name("N");
  fields_command->add_option("--time", frame_time, "The frame nearest to this time")->type_name("TIME");
  fields_command->add_flag("--average", fields_request.average, "Average over all frames, as --frame all");
  fields_command->add_option("--grid", grid, "Nodes along x and y; default: six to the range")->type_name("NX NY");
  fields_command->add_option("--kernel", weight, "Weight function, lucy or monaghan; default: the file's")
      ->type_name("NAME");
  fields_command->add_option("--range", weight_range, "Its range; default: the file's")->type_name("H");
  fields_command->add_option("--out", out, "Directory of the results; default: FILE_fields beside the file")
      ->type_name("DIR");
  fields_command->add_flag_callback(
      "--no-pictures", [&] { fields_request.pictures = false; }, "Do not draw");
  fields_command->set_help_flag("-h,--help", "This text");
  fields_command->footer(
      "\nThe directory may be new, empty, or hold earlier fields, which are replaced.\n"
      "\nExamples:\n"
      "  lucy sweep inputs/quick.toml --set output.frame_interval=20 --out runs/frames\n"
      "  lucy fields runs/frames/point_004.h5\n"
      "  lucy fields runs/frames/point_004.h5 --time 400 --grid 256 256 --kernel monaghan --range 4 --out runs/wider");

  auto* lammps_command = program.add_subcommand("lammps", "The same states in LAMMPS, another engine");
  lammps_command->require_subcommand(1);
  lammps_command->set_help_flag("-h,--help", "This text");
  lammps_command->footer(
      "\nExamples:\n"
      "  lucy lammps check inputs/quick.toml\n"
      "  lucy lammps export inputs/quick.toml --out runs/for_lammps\n"
      "  lucy lammps run runs/for_lammps");
  std::string lammps_program;
  const auto add_lammps = [&](CLI::App* command) {
    command
        ->add_option("--lammps", lammps_program, "The program; default: lmp on PATH (Debian: apt-get install lammps)")
        ->type_name("PROGRAM");
  };
  auto* export_command =
      lammps_command->add_subcommand("export", "Write the states of a sweep as cases for LAMMPS; run nothing there");
  add_input(export_command, "runs/NAME_lammps");
  export_command->footer(
      "\nOne replica of each state. LAMMPS has no ergostat: sheared states get the temperature of a short run of "
      "Lucy's\n"
      "(run.equilibration and up to 200 time units more), or the one that system.kinetic_temperature sets.\n"
      "\nExamples:\n"
      "  lucy lammps export inputs/quick.toml --out runs/for_lammps\n"
      "  lucy lammps export inputs/quick.toml --set system.particles=1048576 --set system.kinetic_temperature=0.5424 "
      "\\\n"
      "    --set shear.strain_rate=0.1 --out runs/large");
  auto* run_command = lammps_command->add_subcommand("run", "Run exported cases with LAMMPS, to a table.csv");
  LammpsRunRequest lammps_request;
  run_command->add_option("DIR", lammps_request.directory, "Directory of a `lucy lammps export`")->required();
  run_command->add_option("--ranks", lammps_request.ranks, "MPI ranks; default: 1")->type_name("N");
  add_lammps(run_command);
  run_command->set_help_flag("-h,--help", "This text");
  run_command->footer(
      "\nStates that are done are not run again, whoever ran them and on however many ranks; LAMMPS must be here only\n"
      "if something is left to run. What was cut off goes on from its last restart file (one every 50000 steps).\n"
      "\nExample:\n"
      "  lucy lammps run runs/for_lammps --ranks 2");
  auto* lammps_check_command = lammps_command->add_subcommand(
      "check", "Compare both engines: single points, trajectories, averages, Green-Kubo");
  add_input(lammps_check_command, "runs/NAME_lammps_check");
  add_lammps(lammps_check_command);
  lammps_check_command->footer(
      "\nExit code 0: every line agrees; 1: not, or LAMMPS is not installed. Averages may differ by four standard\n"
      "errors. Single points, constant energy and Green-Kubo are at the first state of INPUT, without its shear; the "
      "four\n"
      "sheared states are E/N = 1 and 0.5 at the rates 0.1 and 0.5, at density 1 and range 3, whatever INPUT sweeps.\n"
      "\nExample:\n"
      "  lucy lammps check inputs/quick.toml");

  auto* dump_command = program.add_subcommand(
      "read-dump",
      "Particles from LAMMPS (data, dump), extended XYZ or a point file; and into a file of LAMMPS or extended XYZ");
  DumpRequest dump_request;
  std::size_t dump_frame = 0;
  double dump_rate = 0.0;
  dump_command->add_option("FILE", dump_request.file, "LAMMPS data file or dump, extended XYZ, point_NNN.h5")
      ->required();
  dump_command->add_option("--frame", dump_frame, "Number of the frame, from 1; default: all, into .data the last")
      ->type_name("N");
  dump_command->add_option("--replica", dump_request.replica, "Number of the replica in a point file; default: 1")
      ->type_name("N");
  dump_command
      ->add_option("--strain-rate", dump_rate, "Of the flow in the velocities; default: what the file says, or 0")
      ->type_name("RATE");
  dump_command->add_flag("--peculiar", dump_request.peculiar, "Write peculiar velocities, without the flow");
  dump_command
      ->add_option("--out", out,
                   "File to write, a new one: .data (LAMMPS data), .dump (LAMMPS dump), .xyz (extended XYZ)")
      ->type_name("FILE");
  dump_command->set_help_flag("-h,--help", "This text");
  dump_command->footer(
      "\nA sweep starts from such a file with --set 'system.start=\"FILE\"'.\n"
      "\nExamples:\n"
      "  lucy read-dump runs/frames/point_004.h5 --out movie.xyz\n"
      "  lucy read-dump sheared.dump --strain-rate 0.1 --frame 12 --out state.data");

  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants it
    program.parse(reversed);
  } catch (const CLI::Success& asked) {  // --help, --version
    return tell_errors([&] { return program.exit(asked) == 0 ? done : failed; });
  } catch (const CLI::ParseError& error) {
    say(usage_error(program, error, arguments));
    return bad_usage;
  }

  return tell_errors([&] {
    request.input = input;
    if (!out.empty()) request.out = out;
    for (const auto* command :
         {sweep_command, green_kubo_command, isomorphism_command, shear_flow_command, shear_wave_command,
          temperature_wave_command, benard_command, benard_grid_command, check_command, viscosity_command,
          benard_compare_command, fields_command, export_command, lammps_check_command, dump_command})
      if (out.empty() && command->count("--out") > 0)
        throw BadInput(
            fmt::format("--out is empty where a {} is expected", command == dump_command ? "file" : "directory"));
    if (sweep_command->parsed()) return sweep(request);
    if (green_kubo_command->parsed()) {
      if (series_option->count() == 0) {
        for (const auto* option : series_options)
          if (option->count() > 0) throw BadInput(fmt::format("{} needs --from-series", option->get_name()));
        if (input.empty()) throw BadInput("lucy green-kubo needs INPUT, or --from-series FILE");
        return green_kubo(request, !no_pictures);
      }
      if (!input.empty()) throw BadInput(fmt::format("--from-series takes no INPUT, but '{}' is given", input));
      if (!request.overrides.empty()) throw BadInput("--set changes an INPUT, and --from-series has none");
      for (std::size_t i = 0; i < 3; ++i)
        if (series_options[i]->count() == 0)
          throw BadInput(fmt::format("--from-series needs {}", series_options[i]->get_name()));
      const auto given = [](const std::string& text) { return text.empty() ? std::nullopt : std::optional(text); };
      series.file = series_file;
      series.difference = given(difference);
      series.pxx = given(pxx);
      series.pyy = given(pyy);
      if (green_kubo_command->count("--length") > 0) series.length = length;
      if (green_kubo_command->count("--cutoff") > 0) series.cutoff = cutoff;
      series.out = request.out;
      series.command_line = words;
      series.pictures = !no_pictures;
      return green_kubo_series(series);
    }
    if (isomorphism_command->parsed()) return isomorphism(request);
    if (shear_flow_command->parsed()) return shear_flow(request);
    if (shear_wave_command->parsed()) return wave(request, cases::WaveQuantity::shear);
    if (temperature_wave_command->parsed()) return wave(request, cases::WaveQuantity::temperature);
    if (benard_command->parsed()) return benard(request);
    if (benard_grid_command->parsed()) return benard_grid(request);
    if (check_command->parsed()) return check(request, kind);
    if (explain_command->parsed()) return explain(filter, kind.value_or(files::InputKind::sweep));
    if (viscosity_command->parsed()) {
      if (results.size() < 2)
        throw BadInput("lucy viscosity needs the directory of a sweep and that of a Green-Kubo run, in this order");
      return viscosity(std::span(results).first(results.size() - 1), results.back(), request.out);
    }
    if (benard_compare_command->parsed()) {
      if (!published.empty()) convection.published = published;
      if (!effective.empty()) convection.effective = effective;
      convection.out = request.out;
      return benard_compare(convection);
    }
    if (fields_command->parsed()) {
      if (fields_command->count("--frame") > 0) fields_request.frame = frame;
      if (fields_command->count("--time") > 0) fields_request.time = frame_time;
      if (fields_command->count("--grid") > 0) fields_request.grid = grid;
      if (fields_command->count("--kernel") > 0) fields_request.kernel = weight;
      if (fields_command->count("--range") > 0) fields_request.range = weight_range;
      fields_request.out = request.out;
      fields_request.command_line = words;
      return fields(fields_request);
    }
    const auto lammps = lammps_program.empty() ? std::nullopt : std::optional<std::filesystem::path>(lammps_program);
    if (export_command->parsed()) return lammps_export(request);
    if (run_command->parsed()) {
      lammps_request.lammps = lammps;
      lammps_request.command_line = words;
      return lammps_run(lammps_request);
    }
    if (lammps_check_command->parsed()) return lammps_check(request, lammps);
    if (dump_command->parsed()) {
      if (dump_command->count("--frame") > 0) dump_request.frame = dump_frame;
      if (dump_command->count("--strain-rate") > 0) dump_request.strain_rate = dump_rate;
      dump_request.out = request.out;
      return read_dump(dump_request);
    }
    return compare(table, published);
  });
}

}  // namespace lucy::program

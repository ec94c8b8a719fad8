// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands of the program. Each prints its answer on standard output and returns the exit code: 0 done, 1 ran but
// failed (or disagreed). BadInput (2), RunFailed (1) and what else is thrown are for command_line.cpp to tell.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/wave.hpp"
#include "lucy/files/all_inputs.hpp"

namespace lucy::program {

/// The input of a command that reads one, with what the command line changes.
struct InputRequest {
  std::filesystem::path input;
  std::vector<std::string> overrides;             ///< "section.key=value"
  std::optional<std::filesystem::path> out = {};  ///< default: runs/STEM
  std::vector<std::string> command_line = {};     ///< as typed, for the record
};

/// Runs every point of a sweep, or goes on with it, and writes table.csv and its companions (sweep.cpp).
int sweep(const InputRequest& request);

/// Runs every state of a Green-Kubo input, or goes on with it, and writes viscosity.csv and its companions
/// (green_kubo.cpp). `pictures`: draw them.
int green_kubo(const InputRequest& request, bool pictures);

/// Moves atoms and smooth particles side by side and compares all bits, or goes on with it; writes isomorphism.csv
/// (isomorphism.cpp). 1 when anything differs.
int isomorphism(const InputRequest& request);

/// Shears viscous fluids of smooth particles, or goes on with it; writes shear_flow.csv and its companions
/// (shear_flow.cpp).
int shear_flow(const InputRequest& request);

/// Lets shear or temperature waves decay, or goes on with it; writes shear_wave.csv or temperature_wave.csv and their
/// companions (wave.cpp).
int wave(const InputRequest& request, cases::WaveQuantity quantity);

/// Lets smooth particles convect between a hot floor and a cold ceiling, or goes on with it; writes benard.csv and its
/// companions (benard.cpp).
int benard(const InputRequest& request);

/// Lets a continuum convect between a hot floor and a cold ceiling, mesh by mesh, or goes on with it; writes
/// benard_grid.csv and its companions (benard_grid.cpp).
int benard_grid(const InputRequest& request);

/// A stress series that another program sampled.
struct SeriesRequest {
  std::filesystem::path file;
  std::string pxy = "pxy";  ///< columns by name or number
  std::optional<std::string> difference = {};
  std::optional<std::string> pxx = {};
  std::optional<std::string> pyy = {};
  double interval = 0.0;  ///< between rows
  double volume = 0.0;
  double temperature = 0.0;
  std::optional<double> length = {};
  std::optional<double> cutoff = {};
  std::optional<std::filesystem::path> out = {};  ///< default: runs/STEM
  std::vector<std::string> command_line = {};     ///< as typed, for the record
  bool pictures = true;
};

/// The Green-Kubo estimators on such a series (green_kubo.cpp).
int green_kubo_series(const SeriesRequest& request);

/// The viscosities of sweeps extrapolated to zero rate beside those of a Green-Kubo run (viscosity.cpp); directories,
/// or their table.csv and viscosity.csv. `out`: where the files go, default the Green-Kubo directory.
int viscosity(std::span<const std::filesystem::path> sweeps, const std::filesystem::path& green_kubo,
              const std::optional<std::filesystem::path>& out);

/// Results of convection to be laid side by side.
struct BenardCompareRequest {
  std::vector<std::filesystem::path> directories;       ///< of benard and of benard-grid runs, in any order
  std::optional<std::filesystem::path> published = {};  ///< default: the file that comes with Lucy
  std::optional<std::filesystem::path> effective = {};  ///< a benard-grid run with effective coefficients
  std::optional<std::filesystem::path> out = {};        ///< default: the first directory of particles
};

/// Convection by particles beside that of the continuum and beside print; writes benard_compare.csv
/// (benard_compare.cpp).
int benard_compare(const BenardCompareRequest& request);

/// Which state of which file becomes fields, and how.
struct FieldsRequest {
  std::filesystem::path file;
  int replica = 1;                                ///< from 1
  std::optional<std::string> frame = {};          ///< number from 1, or "all"; default: the last
  std::optional<double> time = {};                ///< the nearest frame
  bool average = false;                           ///< over all frames
  std::optional<std::array<int, 2>> grid = {};    ///< default: six nodes to the range
  std::optional<std::string> kernel = {};         ///< default: the file's
  std::optional<double> range = {};               ///< default: the file's
  std::optional<std::filesystem::path> out = {};  ///< default: STEM_fields beside the file
  std::vector<std::string> command_line = {};     ///< as typed, for the record
  bool pictures = true;
};

/// Density, velocity, temperature, pressure and energy of a saved state on a grid, and their spectra (fields.cpp).
int fields(const FieldsRequest& request);

/// Writes the states of a sweep as cases for LAMMPS (lammps.cpp).
int lammps_export(const InputRequest& request);

/// Cases that were exported, run by LAMMPS.
struct LammpsRunRequest {
  std::filesystem::path directory;
  int ranks = 1;
  std::optional<std::filesystem::path> lammps = {};  ///< the program; default: lmp and the like on PATH
  std::vector<std::string> command_line = {};
};

/// Runs them, or goes on with it, and writes table.csv (lammps.cpp).
int lammps_run(const LammpsRunRequest& request);

/// Hands states to LAMMPS and to this engine and compares them line by line, or goes on with it; writes verdict.csv
/// (lammps_check.cpp). 1 when anything differs. `lammps` as above.
int lammps_check(const InputRequest& request, const std::optional<std::filesystem::path>& lammps);

/// A file of particles of whatever program, or of Lucy.
struct DumpRequest {
  std::filesystem::path file;
  int replica = 1;                                ///< of a point file, from 1
  std::optional<std::size_t> frame = {};          ///< number from 1; default: all (into a data file: the last)
  std::optional<double> strain_rate = {};         ///< of the flow in its velocities
  bool peculiar = false;                          ///< write peculiar velocities
  std::optional<std::filesystem::path> out = {};  ///< a file; its name says the format
};

/// Says what is in the file, and writes it in another format (read_dump.cpp).
int read_dump(const DumpRequest& request);

/// Says what an input would do and cost; writes nothing (check.cpp). Without a kind, it is that of kind_of_input.
int check(const InputRequest& request, std::optional<files::InputKind> kind);

/// Prints the keys of an input file (explain.cpp). `filter`: a section or a key, or empty.
int explain(const std::string& filter, files::InputKind kind);

/// A table.csv, or the directory that holds it, beside a published table: by name, or a file (compare.cpp).
int compare(const std::filesystem::path& table, const std::string& published);

}  // namespace lucy::program

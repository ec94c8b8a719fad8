// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LAMMPS as another program: where it is, what version it is, and a script of files/lammps_case.hpp run by it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lucy::program {

/// One script of a case, run in the case's folder.
struct LammpsJob {
  std::filesystem::path folder;
  std::string script;                                               ///< "nve": nve.in
  std::vector<std::pair<std::string, std::string>> variables = {};  ///< set with -var
  int ranks = 1;                                                    ///< more than one: by mpirun
  std::int64_t steps = 0;  ///< of the series that it writes, SCRIPT_series.dat; 0: it writes none
  int series_steps = 1;    ///< between the rows of the series

  std::filesystem::path series() const { return folder / (script + "_series.dat"); }
};

/// A job that has been run to its end.
struct FinishedJob {
  std::string version;   ///< of LAMMPS
  int ranks = 0;         ///< 0: not known, it was run by somebody else
  double seconds = 0.0;  ///< nan: not known, it was interrupted or run by somebody else
};

/// What is known of the job's last run, if that was of this very case (script, variables, start and table, by their
/// checksum) and the series is whole. Run by hand or on another machine it counts too: LAMMPS writes SCRIPT_final.data
/// last of all.
std::optional<FinishedJob> finished_job(const LammpsJob& job);

class Lammps {
 public:
  /// `given`: the program; nothing: the first of lmp, lmp_mpi, lmp_serial, lammps on PATH. Throws RunFailed, saying how
  /// to install it, when there is none, or when it is none.
  explicit Lammps(const std::optional<std::filesystem::path>& given = {});

  /// "29 Sep 2021 - Update 2"
  const std::string& version() const { return version_; }

  /// Runs the job from its beginning and waits for it, calling `goes_on` several times a second, which stops it by
  /// returning false; nothing is returned then. Throws RunFailed with the words of LAMMPS.
  std::optional<FinishedJob> run(const LammpsJob& job, const std::function<bool()>& goes_on) const;

  /// The same from the newer of the restart files that an earlier run of this very case left, whoever ran it; without
  /// one, from the beginning. What went on does not know how long it took in all.
  std::optional<FinishedJob> resume(const LammpsJob& job, const std::function<bool()>& goes_on) const;

 private:
  std::optional<FinishedJob> run_from(const std::string& restart, LammpsJob job,
                                      const std::function<bool()>& goes_on) const;

  std::string program_;
  std::string version_;
};

/// The last step of a series that is being written; 0: none yet.
double last_step_of(const std::filesystem::path& series);

}  // namespace lucy::program

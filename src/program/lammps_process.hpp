// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LAMMPS as another program: where it is, what version it is, and a script of files/lammps_case.hpp run by it.
#pragma once

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
};

class Lammps {
 public:
  /// `given`: the program; nothing: the first of lmp, lmp_mpi, lmp_serial, lammps on PATH. Throws RunFailed, saying how
  /// to install it, when there is none, or when it is none.
  explicit Lammps(const std::optional<std::filesystem::path>& given = {});

  /// "29 Sep 2021 - Update 2"
  const std::string& version() const { return version_; }

  /// Runs the job and waits for it, calling `goes_on` several times a second, which stops it by returning false.
  /// Returns the seconds that it took, from start to end; nothing when it was stopped. Throws RunFailed with the words
  /// of LAMMPS.
  std::optional<double> run(const LammpsJob& job, const std::function<bool()>& goes_on) const;

  /// The same, unless the folder says that this job has been done, by this version of LAMMPS.
  std::optional<double> run_once(const LammpsJob& job, const std::function<bool()>& goes_on) const;

 private:
  std::string program_;
  std::string version_;
};

/// The last step of a series that is being written; 0: none yet.
double last_step_of(const std::filesystem::path& series);

}  // namespace lucy::program

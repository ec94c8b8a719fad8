// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `lucy lammps export`, `run` and `check` share.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/couette_table.hpp"
#include "program/commands.hpp"
#include "program/lammps_process.hpp"

namespace lucy::program {

/// A line of text that one thread changes and another draws.
class SharedLine {
 public:
  void set(std::string text) {
    const std::scoped_lock lock(lock_);
    text_ = std::move(text);
  }
  std::string get() const {
    const std::scoped_lock lock(lock_);
    return text_;
  }

 private:
  mutable std::mutex lock_;
  std::string text_;
};

/// The folder of a state in a directory of cases: point_001.
std::string case_folder_name(std::size_t index);

/// A point of an input as it is handed over: one replica of the stated duration.
cases::CouettePoint handed_over(const cases::CouettePoint& point);

/// The run that ends in a row of a table: nve.in, or sheared.in where the rate is not zero.
LammpsJob main_job(const std::filesystem::path& folder, const cases::CouettePoint& point, int ranks = 1);

/// Writes the record of what was done for or with LAMMPS; `engine`: which one it was, if any.
void write_lammps_provenance(const std::filesystem::path& file, const std::vector<std::string>& command_line,
                             const std::string& engine, int threads, std::uint64_t seed,
                             std::chrono::system_clock::time_point started, const std::vector<double>& seconds);

}  // namespace lucy::program

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads what h5md.hpp wrote: the parameters of a point, and the frames of its replicas. Every case's file will do, as
// long as it was written with output.frame_interval. Parameters that readers look for, where a case has them:
//
//     strain_rate         number; without it the particles are not sheared
//     kernel, range       name of the weight function (kernel::weight_names) and its range h
//     equation_of_state   name (spam::equation_of_state_names); without it the particles are atoms
//     wall                name (space::wall_kind_names) of what is behind walls; without it the box is periodic
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lucy/cases/frame.hpp"

namespace lucy::files {

class H5mdReader {
 public:
  /// Opens one replica (from 1) of a file. Throws BadInput, naming the file and what it is instead: not there, no HDF5,
  /// no H5MD file of Lucy, one without frames or without this replica.
  H5mdReader(const std::filesystem::path& path, int replica);
  ~H5mdReader();
  H5mdReader(H5mdReader&&) noexcept;
  H5mdReader& operator=(H5mdReader&&) noexcept;

  /// A parameter of the point; nothing when the file has none of this name. Throws BadInput when it is of another kind.
  std::optional<double> number(const std::string& name) const;
  std::optional<std::string> word(const std::string& name) const;

  std::int64_t particles() const;
  bool has_internal_energies() const;
  /// One for each frame, in the order of the file.
  const std::vector<double>& times() const;

  /// Frame `index`, from 0, positions wrapped into the box. Throws BadInput when there is no such frame, when it cannot
  /// be read or when its numbers are not finite.
  cases::Frame frame(std::size_t index) const;

 private:
  struct Contents;
  std::unique_ptr<Contents> contents_;
};

}  // namespace lucy::files

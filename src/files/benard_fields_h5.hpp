// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the HDF5 files of convecting fluids have in common, whatever solves their equations: /grid and /fields.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "hdf5_file.hpp"

namespace lucy::files {

inline void write_column(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                         const std::vector<double>& values, std::string_view unit, std::string_view meaning) {
  const hdf5::Handle dataset = hdf5::write_dataset(group, name, shape, values);
  hdf5::add_attribute(dataset, "unit", unit);
  hdf5::add_attribute(dataset, "meaning", meaning);
}

/// x and y of `places` ("nodes"), from the middle of the cell.
inline void write_grid(hid_t file, const std::vector<double>& x, const std::vector<double>& y,
                       std::string_view places) {
  const hdf5::Handle group = hdf5::create_group(file, "grid");
  write_column(group, "x", {x.size()}, x, "sigma", fmt::format("x of the {}", places));
  write_column(group, "y", {y.size()}, y, "sigma", fmt::format("y of the {}", places));
}

}  // namespace lucy::files

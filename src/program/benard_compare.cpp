// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy benard-compare`: convection by particles, by the grid and in print side by side. Nothing is run. Into the first
// directory of particles, or another, go benard_compare.csv and the pictures, in place of earlier ones.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "lucy/cases/benard_comparison.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/benard_comparison_csv.hpp"
#include "lucy/files/benard_comparison_text.hpp"
#include "lucy/files/benard_csv.hpp"
#include "lucy/files/benard_grid_csv.hpp"
#include "lucy/files/directory_lock.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/data_directory.hpp"
#include "program/output_directory.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

constexpr const char* particles_file = "benard.csv";
constexpr const char* grid_file = "benard_grid.csv";
constexpr const char* table_file = "benard_compare.csv";
constexpr const char* picture_stem = "benard_compare";  // of all that plot_benard_compare.py draws

bool holds(const fs::path& directory, const char* name) {
  std::error_code error;  // what cannot be looked at will not be readable either
  return fs::exists(directory / name, error);
}

void require_different(const std::vector<fs::path>& directories) {
  std::error_code error;  // those that are not there are told of elsewhere
  for (std::size_t i = 0; i < directories.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (fs::equivalent(directories[i], directories[k], error))
        throw BadInput(fmt::format("{} is given twice, as {} and as {}: its rows would count twice",
                                   directories[i].string(), directories[k].string(), directories[i].string()));
}

/// The pictures in a directory, in the order of their names.
std::vector<std::string> pictures_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const fs::path extension = entry.path().extension();
    if (entry.path().filename().string().starts_with(picture_stem) && (extension == ".png" || extension == ".svg"))
      names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

int benard_compare(const BenardCompareRequest& request) {
  require_different(request.directories);
  std::vector<cases::BenardRow> particles;
  std::vector<cases::BenardGridRow> grid;
  std::vector<cases::BenardGridRow> effective;
  std::optional<fs::path> first_of_particles;
  for (const fs::path& directory : request.directories) {
    if (holds(directory, particles_file)) {
      std::ranges::move(files::read_benard_csv(directory / particles_file), std::back_inserter(particles));
      if (!first_of_particles) first_of_particles = directory;
    } else if (holds(directory, grid_file)) {
      std::ranges::move(files::read_benard_grid_csv(directory / grid_file), std::back_inserter(grid));
    } else {
      throw BadInput(
          fmt::format("{} holds neither a {} nor a {}, as the directory of a finished benard or benard-grid "
                      "run does",
                      directory.string(), particles_file, grid_file));
    }
  }
  if (!first_of_particles)
    throw BadInput(fmt::format("none of the directories holds a {}: there are no particles to lay beside the grid",
                               particles_file));
  if (request.effective) {
    if (!holds(*request.effective, grid_file))
      throw BadInput(fmt::format("--effective {}: there is no {}, as in the directory of a finished benard-grid run",
                                 request.effective->string(), grid_file));
    effective = files::read_benard_grid_csv(*request.effective / grid_file);
  }
  const auto published = files::read_published_benard(
      request.published ? *request.published : data_directory() / "reference" / "kum1995_benard.csv");

  const auto comparisons = cases::compare_benard(particles, grid, effective, published);
  if (std::ranges::all_of(comparisons, [](const cases::BenardComparison& comparison) {
        return std::ranges::all_of(comparison.rows, [](const auto& row) { return row.beside.empty(); });
      }))
    throw BadInput(
        fmt::format("there is nothing to lay beside {}: no steady flow on a grid, and none in print, has the same "
                    "fluid, sides, temperatures and Rayleigh number",
                    files::benard_particles_text(particles.front().settings)));

  fs::path directory = request.out.value_or(*first_of_particles);
  make_directory(directory);
  const files::DirectoryLock lock(directory);
  files::write_benard_comparison_csv(directory / table_file, comparisons);
  std::error_code error;  // a picture that cannot be removed cannot be replaced either, and the script says so
  for (const std::string& picture : pictures_in(directory)) fs::remove(directory / picture, error);

  print("{}", files::format_benard_comparison(comparisons));
  std::fflush(stdout);
  std::vector<std::string> arguments;
  for (const fs::path& given : request.directories) arguments.push_back(given.string());
  arguments.insert(arguments.end(), {"--out", directory.string()});
  if (request.published) arguments.insert(arguments.end(), {"--published", request.published->string()});
  draw({{"plot_benard_compare.py", arguments, directory / fmt::format("{}.png", picture_stem)}});
  std::vector<std::string> names = pictures_in(directory);
  names.insert(names.begin(), table_file);
  print_files(directory, names);
  return 0;
}

}  // namespace lucy::program

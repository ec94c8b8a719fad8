// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy fields`: a saved state as fields on a grid. Nothing is run. Into a directory of their own go fields.h5,
// spectra.csv and pictures, in place of earlier ones.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "lucy/build_record.hpp"
#include "lucy/cases/saved_fields.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/fields_h5.hpp"
#include "lucy/files/h5md_reader.hpp"
#include "lucy/files/schema.hpp"
#include "lucy/files/table_text.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/output_directory.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> results = {"fields.h5",  "spectra.csv", "fields.png",
                                                "fields.svg", "spectra.png", "spectra.svg"};
constexpr std::int64_t most_nodes = std::int64_t{1} << 22;  // about a gigabyte

/// The entry of a list of names such as kernel::weight_names.
template <class Names>
auto by_name(const Names& names, std::string_view name, const std::string& what) {
  std::string known;
  for (const auto& [word, value] : names) {
    if (word == name) return value;
    known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", word);
  }
  throw BadInput(fmt::format("{} is \"{}\", which is none of {}", what, name, known));
}

/// Whole words for which frames, as indices from 0.
std::vector<std::size_t> chosen_frames(const FieldsRequest& request, const files::H5mdReader& reader) {
  const auto& times = reader.times();
  const std::string range =
      fmt::format("{} has frames 1 to {} of replica {}, from time {} to {}", request.file.string(), times.size(),
                  request.replica, files::format_plain(times.front()), files::format_plain(times.back()));
  if (request.average || request.frame == "all") {
    std::vector<std::size_t> all(times.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }
  if (request.time) {
    const double slack = 1e-9 * std::abs(times.back());
    if (!(*request.time >= times.front() - slack && *request.time <= times.back() + slack))
      throw BadInput(fmt::format("--time is {}, but {}", *request.time, range));
    const auto nearest =
        std::ranges::min_element(times, {}, [&](double time) { return std::abs(time - *request.time); });
    return {static_cast<std::size_t>(nearest - times.begin())};
  }
  if (!request.frame) return {times.size() - 1};
  const std::string& text = *request.frame;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw BadInput(fmt::format("--frame is '{}' where a number from 1 on or 'all' is expected; {}", text, range));
  if (number < 1 || number > times.size()) throw BadInput(fmt::format("--frame is {}, but {}", text, range));
  return {number - 1};
}

void refuse_contradictions(const FieldsRequest& request) {
  if (request.frame && request.time) throw BadInput("--frame and --time choose a frame twice: give one of them");
  if (request.average && (request.time || (request.frame && *request.frame != "all")))
    throw BadInput("--average takes all frames: it goes with neither --frame nor --time");
  if (request.replica < 1)
    throw BadInput(fmt::format("--replica is {}, but replicas are numbered from 1", request.replica));
  if (request.grid) {
    const auto& [n_x, n_y] = *request.grid;
    if (n_x < 2 || n_y < 2 || std::int64_t{n_x} * n_y > most_nodes)
      throw BadInput(fmt::format("--grid is {} x {}, but a grid has at least 2 x 2 nodes and at most {} in all", n_x,
                                 n_y, most_nodes));
  }
  if (request.range && !(std::isfinite(*request.range) && *request.range > 0.0))
    throw BadInput(fmt::format("--range is {}, but the weight function's range is above 0", *request.range));
}

cases::FieldSettings settings_of(const FieldsRequest& request, const files::H5mdReader& reader) {
  const std::string file = request.file.string();
  cases::FieldSettings settings;
  const auto kernel = request.kernel ? request.kernel : reader.word("kernel");
  const auto range = request.range ? request.range : reader.number("range");
  if (!kernel || !range)
    throw BadInput(
        fmt::format("{} does not say with which weight function it was made: give --kernel and --range", file));
  settings.weight =
      by_name(kernel::weight_names, *kernel, request.kernel ? "--kernel" : fmt::format("the kernel of {}", file));
  settings.range = *range;
  settings.strain_rate = reader.number("strain_rate").value_or(0.0);
  if (const auto state = reader.word("equation_of_state"))
    settings.medium = spam::make_equation_of_state(
        by_name(spam::equation_of_state_names, *state, fmt::format("the equation of state of {}", file)));
  return settings;
}

/// Looks without touching anything.
void refuse_what_is_not_ours(const fs::path& directory) {
  std::error_code error;
  const auto status = fs::status(directory, error);
  if (status.type() == fs::file_type::not_found) return;
  if (!fs::is_directory(status))
    throw BadInput(
        fmt::format("{} is a file: fields need a directory that is new, empty, or holds earlier ones (choose "
                    "one with --out)",
                    directory.string()));
  fs::directory_iterator entries(directory, error);
  if (error) throw BadInput(fmt::format("cannot look into {}: {}", directory.string(), error.message()));
  for (const auto& entry : entries) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == ".lock" || std::ranges::any_of(results, [&](const std::string& one) {
                        return name == one || name == fmt::format(".{}.tmp", one);
                      });
    if (!ours)
      throw BadInput(
          fmt::format("{} holds more than earlier fields ({} is there): choose a directory that is new or empty "
                      "with --out",
                      directory.string(), name));
  }
}

std::string heading(const FieldsRequest& request, const cases::FieldSettings& settings,
                    const cases::SavedFields& fields, const std::vector<std::size_t>& frames, std::size_t of_frames) {
  const std::string when =
      frames.size() == 1
          ? fmt::format("frame {} of {}, time {}", frames.front() + 1, of_frames, files::format_plain(fields.time))
          : fmt::format("average over {} frames, time {} to {}", frames.size(), files::format_plain(fields.first_time),
                        files::format_plain(fields.time));
  const std::string medium =
      settings.medium ? fmt::format("smooth particles, {}", files::medium_name(settings.medium)) : std::string("atoms");
  return fmt::format("{}, replica {}, {}:\n{} {}, {} weight of range {}, {} x {} nodes.\n\n", request.file.string(),
                     request.replica, when, fields.particles, medium,
                     settings.weight == kernel::WeightName::lucy ? "Lucy's" : "Monaghan's",
                     files::format_plain(settings.range), settings.grid.nodes[0], settings.grid.nodes[1]);
}

}  // namespace

int fields(const FieldsRequest& request) {
  refuse_contradictions(request);
  const files::H5mdReader reader(request.file, request.replica);
  if (reader.word("wall"))
    throw BadInput(
        fmt::format("{} is of particles between walls, near which fields from particles alone would be wrong; those "
                    "averaged over time, walls and all, are in the file itself, under /fields",
                    request.file.string()));
  const auto frames = chosen_frames(request, reader);
  cases::FieldSettings settings = settings_of(request, reader);
  const auto box = reader.frame(frames.front()).box;
  settings.grid = request.grid ? measure::Grid{*request.grid, box} : measure::default_grid(box, settings.range);
  const fs::path directory =
      request.out.value_or(request.file.parent_path() / (request.file.stem().string() + "_fields"));
  refuse_what_is_not_ours(directory);

  cases::FieldAverage average(settings);
  files::FieldsProvenance provenance;
  for (const std::size_t index : frames) {
    average.add(reader.frame(index));
    provenance.frames.push_back(index + 1);
  }
  const cases::SavedFields found = average.result();

  make_directory(directory);
  const files::DirectoryLock lock(directory);
  const BuildRecord build = build_record();
  provenance.source = request.file.string();
  provenance.replica = request.replica;
  provenance.command_line = request.command_line;
  provenance.version = build.version;
  provenance.commit = build.commit;
  std::error_code error;  // a picture that cannot be removed cannot be replaced either, and the script says so
  for (const char* name : results)
    if (const fs::path path = directory / name; path.extension() == ".png" || path.extension() == ".svg")
      fs::remove(path, error);
  files::write_fields_h5(directory / "fields.h5", settings, found, provenance);
  files::write_spectra_csv(directory / "spectra.csv", found.spectra);

  print("{}{}", heading(request, settings, found, frames, reader.times().size()),
        files::format_fields(settings, found));
  std::fflush(stdout);
  if (request.pictures) draw({{"plot_fields.py", {directory.string()}, directory / "fields.png"}});
  print_files(directory, {results.begin(), results.end()});
  return 0;
}

}  // namespace lucy::program

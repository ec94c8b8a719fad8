// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the text formats of particle_file.hpp have in common: lines with their numbers, numbers with their refusals, and
// the state as it stands in such a file, before it is wrapped and freed of its flow.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/particle_file.hpp"

namespace lucy::files {

/// A file that ends before what it began is there: cut off, or still being written.
class EndsTooEarly : public BadInput {
 public:
  using BadInput::BadInput;
};

/// The lines of a text from some place on, and the sentences about them.
class LineReader {
 public:
  LineReader(std::string path, std::string_view text, std::size_t start = 0, std::size_t line = 1)
      : path_(std::move(path)), text_(text), place_(start), next_line_(line) {}

  /// False at the end of the text.
  bool next(std::string_view& line);
  /// A line that must be there, as a whole; `what` is expected in it. Throws EndsTooEarly.
  std::string_view expect(std::string_view what);
  /// Throws EndsTooEarly when the line that was read last is the file's last one and has no end: half of a number is a
  /// number, too.
  void require_end_of_line() const;
  std::size_t place() const { return place_; }          ///< of the line after this one
  std::size_t next_line() const { return next_line_; }  ///< its number
  bool done() const { return place_ >= text_.size(); }

  /// About the line that was read last.
  [[noreturn]] void refuse(const std::string& what) const;
  double number(std::string_view word, std::string_view what) const;
  std::int64_t integer(std::string_view word, std::string_view what) const;

 private:
  std::string path_;
  std::string_view text_;
  std::size_t place_;
  std::size_t next_line_;
};

/// The words of a line, between blanks; what follows # is no word unless `comments` are.
std::vector<std::string_view> words_of(std::string_view line, bool comments = false);

/// A state as it stands in a file.
struct RawState {
  std::int64_t step = 0;
  std::optional<double> time = {};
  std::optional<double> flow = {};  ///< the strain rate of the velocities, when the file says it
  std::array<double, 2> origin{};
  std::array<double, 2> lengths{};
  double tilt = 0.0;
  std::vector<double> position;  ///< x0 y0 x1 y1 ... by id
  std::vector<double> velocity;  ///< likewise, or empty

  /// The cell from its lowest and highest corners. Refuses an empty one.
  void set_cell(const LineReader& at, std::array<double, 2> low, std::array<double, 2> high, double xy);
};

/// Refuses a mass other than one.
void require_unit_mass(const LineReader& at, double mass);

/// Ids 1 to N in any order, each once.
class IdCount {
 public:
  explicit IdCount(std::size_t particles) : seen_(particles, false) {}
  /// The place of that particle.
  std::size_t take(const LineReader& at, std::int64_t id);

 private:
  std::vector<bool> seen_;
};

RawState read_data(LineReader lines);
RawState read_dump(LineReader lines);
RawState read_extended_xyz(LineReader lines);

/// Passes over one frame of a dump or an XYZ file.
void skip_dump(LineReader& lines);
void skip_extended_xyz(LineReader& lines);

std::string data_text(const RawState& state, const std::string& title);
std::string dump_text(const RawState& state);
std::string extended_xyz_text(const RawState& state);

}  // namespace lucy::files

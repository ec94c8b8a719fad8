// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "particle_text.hpp"

#include <charconv>
#include <cmath>

#include "lucy/files/csv.hpp"

namespace lucy::files {

namespace {

constexpr std::string_view blanks = " \t\r";

}  // namespace

bool LineReader::next(std::string_view& line) {
  if (done()) return false;
  const std::size_t end = std::min(text_.find('\n', place_), text_.size());
  line = text_.substr(place_, end - place_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  place_ = end + 1;
  ++next_line_;
  return true;
}

std::string_view LineReader::expect(std::string_view what) {
  std::string_view line;
  if (!next(line))
    throw EndsTooEarly(fmt::format("{} ends in line {} where {} is expected", path_, next_line_ - 1, what));
  require_end_of_line();
  return line;
}

void LineReader::require_end_of_line() const {
  if (done() && !text_.ends_with('\n'))
    throw EndsTooEarly(fmt::format("{} ends within line {}, which has no end of line", path_, next_line_ - 1));
}

void LineReader::refuse(const std::string& what) const {
  throw BadInput(fmt::format("{}:{}: {}", path_, next_line_ - 1, what));
}

double LineReader::number(std::string_view word, std::string_view what) const {
  const auto value = parse_number(word);
  if (!value || !std::isfinite(*value))
    refuse(fmt::format("'{}' was found where {}, a finite number, is expected", word.substr(0, 40), what));
  return *value;
}

std::int64_t LineReader::integer(std::string_view word, std::string_view what) const {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    refuse(fmt::format("'{}' was found where {}, a whole number, is expected", word.substr(0, 40), what));
  return value;
}

std::vector<std::string_view> words_of(std::string_view line, bool comments) {
  if (!comments) line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;
       at = line.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

void RawState::set_cell(const LineReader& at, std::array<double, 2> low, std::array<double, 2> high, double xy) {
  for (std::size_t d = 0; d < 2; ++d) {
    if (!(high[d] > low[d])) at.refuse(fmt::format("the box ends at {} where it begins at {}", high[d], low[d]));
    lengths[d] = high[d] - low[d];
  }
  origin = low;
  tilt = xy;
}

void require_unit_mass(const LineReader& at, double mass) {
  if (mass != 1.0) at.refuse(fmt::format("the mass is {}, but particles of Lucy have mass one", mass));
}

std::size_t IdCount::take(const LineReader& at, std::int64_t id) {
  if (id < 1 || id > static_cast<std::int64_t>(seen_.size()))
    at.refuse(fmt::format("the particle has the id {}, but ids go from 1 to {}", id, seen_.size()));
  const auto place = static_cast<std::size_t>(id - 1);
  if (seen_[place]) at.refuse(fmt::format("the particle {} stands there twice", id));
  seen_[place] = true;
  return place;
}

}  // namespace lucy::files

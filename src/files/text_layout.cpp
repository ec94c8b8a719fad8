// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lucy/files/table_text.hpp"

namespace lucy::files {

TextTable::TextTable(std::vector<std::string> header, std::size_t left_aligned, LastColumn last)
    : left_aligned_(left_aligned), last_(last) {
  add(std::move(header));
}

std::vector<std::string> TextTable::lines() const {
  std::vector<std::size_t> width(lines_.front().size(), 0);
  for (const auto& cells : lines_)
    for (std::size_t i = 0; i < cells.size(); ++i) width[i] = std::max(width[i], cells[i].size());
  std::vector<std::string> result;
  for (const auto& cells : lines_) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) line += "  ";
      const bool left = i < left_aligned_ || (i + 1 == cells.size() && last_ == LastColumn::words);
      line += left ? fmt::format("{:<{}}", cells[i], width[i]) : fmt::format("{:>{}}", cells[i], width[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result.push_back(std::move(line));
  }
  return result;
}

std::string TextTable::text() const {
  std::string text;
  const auto all = lines();
  const std::size_t width = std::ranges::max(all, {}, &std::string::size).size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += all[i] + '\n';
    if (i == 0) text += std::string(width, '-') + '\n';
  }
  return text;
}

std::string wrapped(const std::string& prefix, std::string_view text) {
  constexpr std::size_t columns = 118;
  std::string result = prefix;
  while (prefix.size() + text.size() > columns) {
    std::size_t end = text.rfind(' ', columns - prefix.size());
    if (end == std::string_view::npos) end = std::min(text.find(' '), text.size());
    result += fmt::format("{}\n{:{}}", text.substr(0, end), "", prefix.size());
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result + std::string(text) + '\n';
}

std::string state_text(std::int64_t particles, double energy_per_particle) {
  return fmt::format("N = {}, E/N = {}", particles, format_plain(energy_per_particle));
}

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string signed_errors(double difference) {
  return std::isnan(difference) ? "nan" : fmt::format("{:+.1f}", difference);
}

}  // namespace lucy::files

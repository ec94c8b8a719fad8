// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How results stand on a terminal: columns of text, wrapped lines, plain decimals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lucy::files {

enum class LastColumn { words, numbers };

/// Columns of text, each as wide as its widest cell; the first `left_aligned` ones and a last one of words start at the
/// left.
class TextTable {
 public:
  TextTable(std::vector<std::string> header, std::size_t left_aligned, LastColumn last = LastColumn::words);
  void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }

  /// The header and the lines, without line feeds.
  std::vector<std::string> lines() const;
  /// All of it, ruled off below the header.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> lines_;
  std::size_t left_aligned_;
  LastColumn last_;
};

/// Lines of at most 118 columns; all but the first start with blanks as wide as `prefix`. Ends with a line feed.
std::string wrapped(const std::string& prefix, std::string_view text);

/// "N = 1024, E/N = 0.5"
std::string state_text(std::int64_t particles, double energy_per_particle);

/// So many decimals; no minus sign before a zero.
std::string fixed(double value, int decimals);

/// A difference in standard errors, with its sign and one decimal: "+1.3"; "nan" when it is not known.
std::string signed_errors(double difference);

}  // namespace lucy::files

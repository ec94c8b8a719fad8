// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of input files share: a folder with one input file, and the sentence with which it is refused.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "lucy/errors.hpp"
#include "scratch.hpp"

namespace lucy::files::testing {

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
inline bool lacks(const std::string& text, const std::string& part) { return !contains(text, part); }
inline bool starts_with(const std::string& text, const std::string& part) { return text.starts_with(part); }
inline bool ends_with(const std::string& text, const std::string& part) { return text.ends_with(part); }

using Overrides = std::vector<std::string>;

/// `text` with its first `from` replaced.
inline std::string with(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test changes a text that is not there: " + from);
  return std::string(text).replace(at, from.size(), to);
}

/// A folder of one test, removed with it; its input file is a.toml.
class InputFolder : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    put(folder_ / "a.toml", text);
    return folder_ / "a.toml";
  }

  /// The message with which `read` refuses, without the folder; "accepted" when it does not.
  template <class Read>
  std::string refusal_from(const Read& read) const {
    try {
      read();
    } catch (const BadInput& error) {
      std::string message = error.what();
      const std::string prefix = folder_.path().string() + "/";
      for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
      EXPECT_PRED2(lacks, message, "\n");
      return message;
    }
    return "accepted";
  }

  ScratchFolder folder_;
};

/// The same, whose file is read by `Read`.
template <auto Read>
class FolderReadBy : public InputFolder {
 protected:
  auto read(const std::string& text, const Overrides& overrides = {}) const { return Read(write(text), overrides); }
  std::string refusal(const std::string& text, const Overrides& overrides = {}) const {
    return refusal_from([&] { read(text, overrides); });
  }
};

}  // namespace lucy::files::testing

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/build_identity.hpp"

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "lucy/build_record.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/checkpoint.hpp"

namespace lucy::program {

std::string build_identity() {
  const BuildRecord build = build_record();
  std::string text =
      fmt::format("Lucy {}, commit {}, {}, {}", build.version, build.commit, build.compiler, build.flags);
  if (build.commit == "unknown" || build.commit.ends_with("-modified")) {
    const std::string program = files::read_text_file("/proc/self/exe");
    text += fmt::format(", program {:016x}", files::crc64(std::as_bytes(std::span(program))));
  }
  return text;
}

files::Provenance provenance_of(const std::vector<std::string>& command_line) {
  const BuildRecord build = build_record();
  files::Provenance provenance;
  provenance.version = build.version;
  provenance.commit = build.commit;
  provenance.compiler = build.compiler;
  provenance.flags = build.flags;
  provenance.command_line = command_line;
  return provenance;
}

}  // namespace lucy::program

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy read-dump`: what is in a file of particles, and the same in another format.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/table_text.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"

namespace lucy::program {

namespace {

using files::format_plain;
using files::ParticleState;

/// Box, tilt, density, and what the momenta say.
std::string description(const ParticleState& state) {
  const cases::Frame& frame = state.frame;
  const std::size_t particles = frame.position.size() / 2;
  const auto n = static_cast<double>(particles);
  // A tilt below what nine digits of the box can show comes from rounding the strain.
  double tilt = files::tilt_of(frame);
  if (std::abs(tilt) < 1e-9 * frame.box[0]) tilt = 0.0;
  std::string text =
      fmt::format("box {} x {}, tilt {}, density {}", format_plain(frame.box[0], 9), format_plain(frame.box[1], 9),
                  format_plain(tilt, 9), format_plain(n / (frame.box[0] * frame.box[1]), 9));
  if (frame.momentum.empty()) return text + "; no velocities";
  double total[2] = {0.0, 0.0};
  double square = 0.0;
  for (std::size_t i = 0; i < frame.momentum.size(); ++i) {
    total[i % 2] += frame.momentum[i];
    square += frame.momentum[i] * frame.momentum[i];
  }
  const double mean = std::hypot(total[0], total[1]) / n;
  const double temperature = 0.5 * (square - n * mean * mean) / (n - 1.0);
  return text + fmt::format("\npeculiar velocities, {}: kT = {}, mean {}",
                            state.flow != 0.0
                                ? fmt::format("the flow of strain rate {} taken out", format_plain(state.flow))
                                : std::string("as they are in the file"),
                            format_plain(temperature), format_plain(mean, 2));
}

/// Refuses to write over the file that is read, and over any other that holds something else. True when all of `text`
/// is there already.
bool look_at_output(const std::filesystem::path& out, const std::filesystem::path& read, const std::string& text) {
  std::error_code error;
  if (!std::filesystem::exists(out, error)) return false;
  if (std::filesystem::equivalent(out, read, error))
    throw BadInput(fmt::format("--out {} is the file that is read: choose another name", out.string()));
  if (!std::filesystem::is_regular_file(out, error) || files::read_text_file(out) != text)
    throw BadInput(
        fmt::format("--out {} exists and holds something else: choose another name, or remove it first", out.string()));
  return true;
}

}  // namespace

int read_dump(const DumpRequest& request) {
  if (request.replica < 1)
    throw BadInput(fmt::format("--replica is {}, but replicas are numbered from 1", request.replica));
  if (request.strain_rate && !std::isfinite(*request.strain_rate))
    throw BadInput(fmt::format("--strain-rate is {}, but a finite number is expected", *request.strain_rate));
  const files::ParticleReader reader(request.file, request.replica);
  const std::size_t begun = reader.frames() + (reader.has_unfinished_frame() ? 1 : 0);
  if (request.frame && (*request.frame < 1 || *request.frame > begun))
    throw BadInput(fmt::format("--frame is {}, but {} has frames 1 to {}", *request.frame, request.file.string(),
                               reader.frames()));
  const bool ours = reader.format() == files::ParticleFormat::h5md;
  if (ours && request.strain_rate)
    throw BadInput(fmt::format("--strain-rate is {}, but {} is a point file of Lucy, which knows its own",
                               *request.strain_rate, request.file.string()));

  const std::size_t shown = request.frame.value_or(reader.frames()) - 1;
  const ParticleState last = reader.state(shown, request.strain_rate);
  print("{}: {}, {} frame{} of {} particles{}.\n", request.file.string(), files::format_name(reader.format()),
        reader.frames(), reader.frames() == 1 ? "" : "s", last.frame.position.size() / 2,
        reader.has_unfinished_frame() ? ", and one that is not finished" : "");
  print("Frame {}, {}: {}.\n", shown + 1,
        last.time ? fmt::format("time {}", format_plain(*last.time, 9)) : fmt::format("step {}", last.frame.step),
        description(last));
  if (!request.out) return 0;

  const files::ParticleFormat format = files::format_of_name(*request.out);
  const bool data = format == files::ParticleFormat::lammps_data;  // holds one frame
  const std::size_t first = request.frame || data ? shown : 0;
  std::string text;
  for (std::size_t i = first; i <= shown; ++i) {
    const ParticleState state = reader.state(i, request.strain_rate);
    const double flow = request.peculiar ? 0.0 : ours ? reader.strain_rate().value_or(0.0) : state.flow;
    text += files::particle_text(
        format, state.frame, flow,
        fmt::format("Particles of {}, time {}", request.file.filename().string(), format_plain(state.frame.time, 9)));
  }
  const bool there = look_at_output(*request.out, request.file, text);
  if (!there) files::write_file_atomically(*request.out, text);
  const std::size_t frames = shown - first + 1;
  print("{}: {}, {}, {}.\n", there ? "There already" : "Written", request.out->string(), files::format_name(format),
        data && !request.frame && reader.frames() > 1 ? "the last frame (a data file holds one)"
                                                      : fmt::format("{} frame{}", frames, frames == 1 ? "" : "s"));
  return 0;
}

}  // namespace lucy::program

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of a sweep before it is run: particle-steps from the input, the speed from a fifth of a second of the real
// thing on as many threads as the sweep would use.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/table_text.hpp"
#include "program/commands.hpp"
#include "program/prediction.hpp"

namespace lucy::program {

namespace {

using Clock = std::chrono::steady_clock;
using files::format_plain;

constexpr double measured_seconds = 0.2;

// What is measured must not last, nor fill the memory, however large the point: a particle's step costs about the same
// in a smaller system, and in a sample of fewer steps.
constexpr std::int64_t most_particles = 1'000'000;
constexpr int most_steps = 10;

std::string_view thermostat_name(motion::Thermostat thermostat) {
  for (const auto& [name, value] : motion::thermostat_names)
    if (value == thermostat) return name;
  return "unknown";
}

void print_rows(const files::SweepInput& input) {
  std::vector<std::vector<std::string>> table = {
      {"", "N", "E/N", "rate", "thermostat", "step", "equilibration", "duration", "replicas"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const auto& point = input.points[i];
    const auto durations = recorded_durations(point);
    std::string duration = format_plain(point.duration);
    if (durations.size() > 1) duration += fmt::format(" to {}", format_plain(durations.back()));
    table.push_back({fmt::format("{}", i + 1), fmt::format("{}", point.particles),
                     format_plain(point.energy_per_particle), format_plain(point.strain_rate),
                     std::string(thermostat_name(point.thermostat)), format_plain(point.step),
                     format_plain(point.equilibration), duration, fmt::format("{}", point.replicas)});
  }
  std::vector<std::size_t> widths(table.front().size(), 0);
  for (const auto& cells : table)
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  for (const auto& cells : table) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
      line += fmt::format("{}{:>{}}", i == 0 ? "" : "  ", cells[i], widths[i]);
    fmt::print("{}\n", line);
  }
}

/// Keys that are set but that no row makes use of, and what would.
std::vector<std::string> keys_without_effect(const std::vector<cases::CouettePoint>& points) {
  using cases::CouettePoint;
  const auto is = [](motion::Thermostat thermostat) {
    return [thermostat](const CouettePoint& point) { return point.thermostat == thermostat; };
  };
  const auto isokinetic = is(motion::Thermostat::isokinetic);
  const auto nose_hoover = is(motion::Thermostat::nose_hoover);
  std::vector<std::string> sentences;
  const auto look = [&](std::string_view key, std::string_view user, const auto& set, const auto& used) {
    if (std::ranges::any_of(points, set) &&
        std::ranges::none_of(points, [&](const CouettePoint& point) { return set(point) && used(point); }))
      sentences.push_back(fmt::format("without effect: {} (used only {})", key, user));
  };
  look(
      "system.kinetic_temperature", "with the thermostat isokinetic or nose-hoover",
      [](const CouettePoint& point) { return point.kinetic_temperature.has_value(); },
      [&](const CouettePoint& point) { return isokinetic(point) || nose_hoover(point); });
  look(
      "shear.relaxation_time", "with the thermostat nose-hoover",
      [](const CouettePoint& point) { return point.relaxation_time != CouettePoint{}.relaxation_time; }, nose_hoover);
  look(
      "run.maximum_duration", "with run.target_relative_error",
      [](const CouettePoint& point) { return point.maximum_duration > 0.0; },
      [](const CouettePoint& point) { return point.target_relative_error.has_value(); });
  return sentences;
}

struct Measurement {
  double speed = 0.0;        ///< particle-steps per second of one task
  double state_bytes = 0.0;  ///< of a checkpoint, per particle
};

cases::CouettePoint measurable(cases::CouettePoint point) {
  point.sample_interval = std::min(cases::sample_steps(point), most_steps) * point.step;
  point.frame_interval = 0.0;
  point.particles = std::min(point.particles, most_particles);
  return point;
}

/// Runs the start of a measurable `point` on `copies` threads at once, each copy with `threads_inside`.
Measurement measure(const cases::CouettePoint& point, int copies, int threads_inside) {
  std::atomic<double> speeds = 0.0;
  std::atomic<double> bytes = 0.0;
  {
    std::vector<std::jthread> threads;
    for (int copy = 0; copy < copies; ++copy)
      threads.emplace_back([&, copy] {
        try {
          cases::CouetteRun run(point, copy, threads_inside);
          run.advance_one_sample();  // the first one finds cold caches
          const auto begin = Clock::now();
          double seconds = 0.0;
          int intervals = 0;
          while (seconds < measured_seconds) {
            run.advance_one_sample();
            ++intervals;
            seconds = std::chrono::duration<double>(Clock::now() - begin).count();
          }
          speeds += intervals * interval_cost(point) / seconds;
          ArchiveWriter archive;
          run.save(archive);
          bytes = static_cast<double>(archive.bytes().size()) / static_cast<double>(point.particles);
        } catch (const std::exception&) {
          // A point that fails, or does not fit into memory, has no speed; running it will tell why.
        }
      });
  }
  return {speeds / copies, bytes};
}

/// "302 thousand", "4.2 million", "1.2 billion" (10^9).
std::string count_text(double count) {
  if (count < 1e6) return fmt::format("{} thousand", format_plain(count / 1e3, 3));
  if (count < 1e9) return fmt::format("{} million", format_plain(count / 1e6, 3));
  return fmt::format("{} billion", format_plain(count / 1e9, 3));
}

/// What a sweep writes, in bytes.
struct DiskUse {
  double results = 0.0;
  double checkpoints = 0.0;  ///< removed at the end
};

DiskUse predict_disk_use(const files::SweepInput& input, double state_bytes, bool at_most) {
  DiskUse use{2.5e5, 0.0};  // the plot
  for (const auto& point : input.points) {
    const auto durations = recorded_durations(point);
    const double duration = at_most ? durations.back() : durations.front();
    const double samples = duration / (cases::sample_steps(point) * point.step);
    const double frames = point.frame_interval > 0.0 ? 1.0 + duration / point.frame_interval : 0.0;
    const auto particles = static_cast<double>(point.particles);
    constexpr double sample_bytes = sizeof(cases::Sample);
    // Beside the samples: their step and time; position, velocity and momentum of a frame; what HDF5 needs itself.
    use.results += point.replicas * (samples * (sample_bytes + 16.0) + 22e3) + frames * particles * 48.0;
    use.checkpoints +=
        2.0 * point.replicas * (particles * state_bytes + samples * sample_bytes) + frames * particles * 32.0;
  }
  return use;
}

}  // namespace

int check(const InputRequest& request) {
  const files::SweepInput input = files::read_sweep(request.input, request.overrides);
  const int threads = input.threads > 0 ? input.threads : available_cores();
  fmt::print("{}{}{} point{}, {} thread{}:\n\n", input.title, input.title.empty() ? "" : "\n", input.points.size(),
             input.points.size() == 1 ? "" : "s", threads, threads == 1 ? "" : "s");
  print_rows(input);
  const auto idle_keys = keys_without_effect(input.points);
  if (!idle_keys.empty()) fmt::print("\n{}\n", fmt::join(idle_keys, "\n"));

  std::optional<cases::CouettePoint> small_point;
  std::optional<cases::CouettePoint> large_point;
  bool open_ended = false;
  std::vector<double> small_least;
  std::vector<double> small_most;
  double large_least = 0.0;
  double large_most = 0.0;
  for (const auto& point : input.points) {
    const auto durations = recorded_durations(point);
    open_ended = open_ended || durations.size() > 1;
    const double least = static_cast<double>(sample_intervals(point, durations.front())) * interval_cost(point);
    const double most = static_cast<double>(sample_intervals(point, durations.back())) * interval_cost(point);
    const bool large = is_large(point);
    auto& example = large ? large_point : small_point;
    if (!example) example = measurable(point);
    for (int replica = 0; replica < point.replicas; ++replica) {
      if (large) {
        large_least += least;
        large_most += most;
      } else {
        small_least.push_back(least);
        small_most.push_back(most);
      }
    }
  }

  const int copies = std::min<int>(threads, static_cast<int>(small_least.size()));
  const Measurement small = small_point ? measure(*small_point, copies, 1) : Measurement{};
  const Measurement large = large_point ? measure(*large_point, 1, threads) : Measurement{};
  const auto work = [&](const std::vector<double>& smalls, double larges) {
    double sum = larges;
    for (const double cost : smalls) sum += cost;
    return sum;
  };
  const auto seconds = [&](const std::vector<double>& smalls, double larges) {
    double sum = 0.0;
    if (!smalls.empty()) sum += time_on_workers(smalls, threads) / small.speed;
    if (larges > 0.0) sum += larges / large.speed;
    return sum;
  };
  const auto span = [open_ended](const std::string& least, const std::string& most) {
    return open_ended ? fmt::format("{} to {}", least, most) : least;
  };

  fmt::print("\nwork: {} particle-steps\n",
             span(count_text(work(small_least, large_least)), count_text(work(small_most, large_most))));
  const auto say_speed = [](const Measurement& measured, std::int64_t particles, int busy, std::string_view how) {
    fmt::print("speed: {} ns per particle and step, {}, measured just now on this machine with N = {} ({} busy)\n",
               measured.speed > 0.0 ? format_plain(1e9 / measured.speed, 3) : "unknown", how, particles,
               busy == 1 ? "1 thread" : fmt::format("{} threads", busy));
  };
  if (small_point) say_speed(small, small_point->particles, copies, "one replica on each thread");
  if (large_point) say_speed(large, large_point->particles, threads, "one replica on all threads");
  fmt::print("wall time: about {}\n",
             span(duration_text(seconds(small_least, large_least)), duration_text(seconds(small_most, large_most))));
  const double state_bytes = std::max(small.state_bytes, large.state_bytes);
  const DiskUse least = predict_disk_use(input, state_bytes, false);
  const DiskUse most = predict_disk_use(input, state_bytes, true);
  fmt::print("disk: about {} of results, and up to {} of checkpoints while it runs\n",
             span(size_text(least.results), size_text(most.results)),
             span(size_text(least.checkpoints), size_text(most.checkpoints)));
  return 0;
}

}  // namespace lucy::program

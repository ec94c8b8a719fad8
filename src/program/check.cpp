// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of a run before it is run: particle-steps from the input, the speed from a fifth of a second of the real
// thing on as many threads as the run would use.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/files/all_inputs.hpp"
#include "lucy/files/benard_grid_input.hpp"
#include "lucy/files/benard_grid_text.hpp"
#include "lucy/files/benard_input.hpp"
#include "lucy/files/benard_text.hpp"
#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/isomorphism_input.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/shear_flow_text.hpp"
#include "lucy/files/table_text.hpp"
#include "lucy/files/wave_input.hpp"
#include "lucy/files/wave_text.hpp"
#include "lucy/measure/correlator.hpp"
#include "program/benard_grid_point.hpp"
#include "program/benard_point.hpp"
#include "program/commands.hpp"
#include "program/couette_point.hpp"
#include "program/green_kubo_point.hpp"
#include "program/isomorphism_point.hpp"
#include "program/prediction.hpp"
#include "program/shear_flow_point.hpp"
#include "program/wave_point.hpp"

namespace lucy::program {

namespace {

using Clock = std::chrono::steady_clock;
using files::format_plain;

constexpr double measured_seconds = 0.2;

// What is measured must not last, nor fill the memory, however large the point: a particle's step costs about the same
// in a smaller system, in an interval of fewer steps, and with fewer times to correlate.
constexpr std::int64_t most_particles = 1'000'000;
constexpr int most_steps = 10;
constexpr std::int64_t most_lags = 1000;

std::string_view thermostat_name(motion::Thermostat thermostat) {
  for (const auto& [name, value] : motion::thermostat_names)
    if (value == thermostat) return name;
  return "unknown";
}

void print_table(const std::vector<std::vector<std::string>>& table) {
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

std::vector<std::vector<std::string>> rows_of(const files::SweepInput& input) {
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
  return table;
}

std::vector<std::vector<std::string>> rows_of(const files::GreenKuboInput& input) {
  std::vector<std::vector<std::string>> table = {{"", "N", "E/N", "integrator", "step", "equilibration", "duration",
                                                  "replicas", "samples every", "correlated to", "blocks"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const auto& point = input.points[i];
    const double interval = cases::sample_interval(point);
    std::string_view integrator;
    for (const auto& [name, value] : motion::integrator_names)
      if (value == point.integrator) integrator = name;
    table.push_back({fmt::format("{}", i + 1), fmt::format("{}", point.particles),
                     format_plain(point.energy_per_particle), std::string(integrator), format_plain(point.step),
                     format_plain(point.equilibration), format_plain(point.duration), fmt::format("{}", point.replicas),
                     format_plain(interval), format_plain(interval * static_cast<double>(cases::lag_count(point) - 1)),
                     fmt::format("{}", point.replicas * cases::block_count(point))});
  }
  return table;
}

std::vector<std::vector<std::string>> rows_of(const files::IsomorphismInput& input) {
  std::vector<std::vector<std::string>> table = {{"", "N", "E/N", "rate", "thermostat", "P0", "rho0", "step",
                                                  "equilibration", "duration", "replicas", "samples every"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const auto& point = input.points[i];
    table.push_back({fmt::format("{}", i + 1), fmt::format("{}", point.particles),
                     format_plain(point.energy_per_particle), format_plain(point.strain_rate),
                     std::string(thermostat_name(cases::sweep_row(point).thermostat)), format_plain(point.pressure),
                     format_plain(point.reference_density), format_plain(point.step), format_plain(point.equilibration),
                     format_plain(point.duration), fmt::format("{}", point.replicas),
                     format_plain(cases::sample_steps(point) * point.step)});
  }
  return table;
}

std::vector<std::vector<std::string>> rows_of(const files::ShearFlowInput& input) {
  std::vector<std::vector<std::string>> table = {
      {"", "N", "fluid", "conductivity", "step", "equilibration", "duration", "replicas", "samples every"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const auto& point = input.points[i];
    table.push_back({fmt::format("{}", i + 1), fmt::format("{}", point.particles), files::shear_flow_label(point),
                     format_plain(point.conductivity), format_plain(point.step), format_plain(point.equilibration),
                     format_plain(point.duration), fmt::format("{}", point.replicas),
                     format_plain(cases::sample_steps(point) * point.step)});
  }
  return table;
}

std::vector<std::vector<std::string>> rows_of(const files::WaveInput& input) {
  std::vector<std::vector<std::string>> table = {{"", fmt::format("{}s", files::command_name(input.quantity)), "step",
                                                  "equilibration", "duration", "replicas", "samples every"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const auto& point = input.points[i];
    const std::string difference = files::wave_difference(point, input.points.front());
    table.push_back({fmt::format("{}", i + 1), i == 0 ? files::wave_label(point) : difference, format_plain(point.step),
                     format_plain(point.equilibration), format_plain(point.duration), fmt::format("{}", point.replicas),
                     format_plain(cases::wave_schedule(point).sample_interval(point))});
  }
  return table;
}

std::vector<std::vector<std::string>> rows_of(const files::BenardInput& input) {
  std::vector<std::vector<std::string>> table = {
      {"", "fluid", "viscosity", "conductivity", "step", "equilibration", "duration", "replicas", "samples every"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const cases::BenardPoint point = cases::resolved(input.points[i]);
    table.push_back({fmt::format("{}", i + 1), files::benard_label(point), format_plain(*point.viscosity),
                     format_plain(*point.conductivity), format_plain(point.step), format_plain(point.equilibration),
                     format_plain(point.duration), fmt::format("{}", point.replicas),
                     format_plain(cases::sample_steps(point) * point.step)});
  }
  return table;
}

std::vector<std::vector<std::string>> rows_of(const files::BenardGridInput& input) {
  std::vector<std::vector<std::string>> table = {
      {"", "fluid", "find", "viscosity", "conductivity", "step", "duration at most"}};
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const cases::BenardGridPoint point = cases::resolved(input.points[i]);
    std::string_view goal;
    for (const auto& [name, value] : cases::benard_goal_names)
      if (value == point.find) goal = name;
    table.push_back({fmt::format("{}", i + 1), files::benard_grid_label(point), std::string(goal),
                     format_plain(*point.viscosity), format_plain(*point.conductivity), format_plain(*point.step),
                     format_plain(*point.duration)});
  }
  return table;
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

/// A point as it would be run, and the part of it that is run here.
struct Planned {
  std::unique_ptr<StatePoint> point;
  std::unique_ptr<StatePoint> measurable;
};

Planned planned(const cases::CouettePoint& point) {
  cases::CouettePoint measurable = point;
  measurable.sample_interval = std::min(cases::sample_steps(point), most_steps) * point.step;
  measurable.frame_interval = 0.0;
  measurable.particles = std::min(point.particles, most_particles);
  return {std::make_unique<CouetteStatePoint>(point), std::make_unique<CouetteStatePoint>(measurable)};
}

Planned planned(const cases::GreenKuboPoint& point) {
  const auto steps = std::min<std::int64_t>(std::llround(cases::sample_interval(point) / point.step), most_steps);
  const double sample = static_cast<double>(steps) * point.step;
  const auto lags = std::clamp<std::int64_t>(static_cast<std::int64_t>(cases::lag_count(point)) - 1, 1, most_lags);
  cases::GreenKuboPoint measurable = point;
  measurable.preparation = 0.0;  // what takes long is at rest
  measurable.equilibration = 0.0;
  measurable.sample_interval = sample;
  const std::int64_t samples = most_steps / steps;
  measurable.frame_interval = static_cast<double>(samples) * sample;  // no interval is longer
  measurable.length = static_cast<double>(lags) * sample;
  measurable.cutoff = 0.0;
  measurable.duration = 10.0 * measurable.length;
  measurable.energy_band = std::numeric_limits<double>::max();  // the lattice, unprepared, may leave that of a fluid
  measurable.particles = std::min(point.particles, most_particles);
  return {std::make_unique<GreenKuboStatePoint>(point), std::make_unique<GreenKuboStatePoint>(measurable)};
}

Planned planned(const cases::IsomorphismPoint& point) {
  cases::IsomorphismPoint measurable = point;
  measurable.sample_interval = std::min(cases::sample_steps(point), most_steps) * point.step;
  measurable.equilibration = 0.0;
  measurable.particles = std::min(point.particles, most_particles);
  return {std::make_unique<IsomorphismStatePoint>(point), std::make_unique<IsomorphismStatePoint>(measurable)};
}

Planned planned(const cases::ShearFlowPoint& point) {
  cases::ShearFlowPoint measurable = point;
  measurable.sample_interval = std::min(cases::sample_steps(point), most_steps) * point.step;
  measurable.frame_interval = 0.0;
  measurable.particles = std::min(point.particles, most_particles);
  return {std::make_unique<ShearFlowStatePoint>(point), std::make_unique<ShearFlowStatePoint>(measurable)};
}

Planned planned(const cases::WavePoint& point) {
  const auto steps = std::min<std::int64_t>(cases::wave_schedule(point).steps_per_sample, most_steps);
  cases::WavePoint measurable = point;
  measurable.equilibration = 0.0;
  measurable.sample_interval = static_cast<double>(steps) * point.step;
  const std::int64_t most_samples = most_steps / steps;  // no interval is longer
  measurable.frame_interval = static_cast<double>(most_samples) * measurable.sample_interval;
  measurable.duration = 1e6 * measurable.sample_interval;
  measurable.particles = std::min(point.particles, most_particles);
  return {std::make_unique<WaveStatePoint>(point), std::make_unique<WaveStatePoint>(measurable)};
}

Planned planned(const cases::BenardPoint& point) {
  cases::BenardPoint measurable = cases::resolved(point);
  if (point.particles > most_particles) {
    measurable.height = std::floor(std::sqrt(0.5 * static_cast<double>(most_particles)));
    measurable.width = 2.0 * measurable.height;
    measurable.particles = std::llround(measurable.height * *measurable.width);
  }
  measurable.rayleigh.reset();  // its viscosity and conductivity are known
  measurable.sample_interval = std::min(cases::sample_steps(point), most_steps) * point.step;
  measurable.equilibration = 0.0;
  measurable.duration = 1e6 * measurable.sample_interval;
  measurable.frame_interval = 0.0;
  return {std::make_unique<BenardStatePoint>(point), std::make_unique<BenardStatePoint>(measurable)};
}

Planned planned(const cases::BenardGridPoint& point) {
  // Its intervals are short.
  return {std::make_unique<BenardGridStatePoint>(point), std::make_unique<BenardGridStatePoint>(point)};
}

struct Measurement {
  double speed = 0.0;        ///< particle-steps per second of one task
  double state_bytes = 0.0;  ///< of a checkpoint, per particle
};

/// Runs the start of a measurable `point` on `copies` threads at once, each copy with `threads_inside`.
Measurement measure(const StatePoint& point, int copies, int threads_inside) {
  std::atomic<double> speeds = 0.0;
  std::atomic<double> bytes = 0.0;
  {
    std::vector<std::jthread> threads;
    for (int copy = 0; copy < copies; ++copy)
      threads.emplace_back([&, copy] {
        try {
          const auto run = point.start(copy, threads_inside);
          run->advance();  // the first one finds cold caches
          const auto begin = Clock::now();
          double seconds = 0.0;
          int intervals = 0;
          while (seconds < measured_seconds) {
            run->advance();
            ++intervals;
            seconds = std::chrono::duration<double>(Clock::now() - begin).count();
          }
          speeds += intervals * point.interval_cost() / seconds;
          ArchiveWriter archive;
          run->save(archive);
          bytes = static_cast<double>(archive.bytes().size()) / static_cast<double>(point.particles());
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

/// What a run writes, in bytes.
struct DiskUse {
  double results = 0.0;
  double checkpoints = 0.0;  ///< removed at the end
};

constexpr double picture_bytes = 2.5e5;
constexpr double hdf5_bytes = 22e3;       // what it needs itself for one replica
constexpr double most_segment = 32768.0;  // samples in one spectrum

/// Position, velocity and momentum of `duration`'s frames, and what is kept of them while it runs.
void add_frames(DiskUse& use, std::int64_t particles, double frame_interval, double duration) {
  const double frames = frame_interval > 0.0 ? 1.0 + duration / frame_interval : 0.0;
  use.results += frames * static_cast<double>(particles) * 48.0;
  use.checkpoints += frames * static_cast<double>(particles) * 32.0;
}

DiskUse predict_disk_use(const files::SweepInput& input, double state_bytes, bool at_most) {
  DiskUse use{picture_bytes, 0.0};
  for (const auto& point : input.points) {
    const auto durations = recorded_durations(point);
    const double duration = at_most ? durations.back() : durations.front();
    const double samples = duration / (cases::sample_steps(point) * point.step);
    constexpr double sample_bytes = sizeof(cases::Sample);
    // Beside the samples: their step and time.
    use.results += point.replicas * (samples * (sample_bytes + 16.0) + hdf5_bytes);
    use.checkpoints +=
        2.0 * point.replicas * (static_cast<double>(point.particles) * state_bytes + samples * sample_bytes);
    add_frames(use, point.particles, point.frame_interval, duration);
  }
  return use;
}

DiskUse predict_disk_use(const files::IsomorphismInput& input, double state_bytes, bool /*at_most*/) {
  DiskUse use;
  for (const auto& point : input.points) {
    use.results += 4e3;
    const double samples = point.duration / (cases::sample_steps(point) * point.step);
    use.checkpoints +=
        2.0 * point.replicas *
        (static_cast<double>(point.particles) * state_bytes + samples * sizeof(cases::IsomorphismSample));
  }
  return use;
}

DiskUse predict_disk_use(const files::ShearFlowInput& input, double state_bytes, bool /*at_most*/) {
  DiskUse use{picture_bytes, 0.0};
  for (const auto& point : input.points) {
    const double samples = point.duration / (cases::sample_steps(point) * point.step);
    constexpr double sample_bytes = sizeof(cases::ShearFlowSample);
    // Beside the samples: their step and time, of averages and of instants.
    use.results += point.replicas * (samples * (sample_bytes + 32.0) + 2.0 * hdf5_bytes);
    use.checkpoints +=
        2.0 * point.replicas * (static_cast<double>(point.particles) * state_bytes + samples * sample_bytes);
    add_frames(use, point.particles, point.frame_interval, point.duration);
  }
  return use;
}

DiskUse predict_disk_use(const files::WaveInput& input, double state_bytes, bool /*at_most*/) {
  DiskUse use{4.0 * picture_bytes, 0.0};
  for (const auto& point : input.points) {
    const auto samples = static_cast<double>(cases::wave_schedule(point).samples);
    use.results += samples * 150.0 + 4e3;
    if (point.frame_interval > 0.0) use.results += point.replicas * (samples * 64.0 + hdf5_bytes);
    use.checkpoints += 2.0 * point.replicas *
                       (static_cast<double>(point.particles) * state_bytes + samples * sizeof(cases::WaveSample));
    add_frames(use, point.particles, point.frame_interval, point.duration);
  }
  return use;
}

/// A checkpoint of a replica but for its series, in bytes. Correlators are of a size that has little to do with the
/// number of particles: it is counted, as of the classes in measure/, not measured.
double checkpoint_bytes(const cases::GreenKuboPoint& point) {
  const std::size_t lags = cases::lag_count(point);
  const auto per_level = static_cast<double>(measure::MultipleTauCorrelator::Settings{}.lags_per_level);
  const double levels = 1.0 + std::max(0.0, std::ceil(std::log2(static_cast<double>(lags - 1) / (per_level - 1.0))));
  double correlator = 8.0 * (3.0 * per_level + 1.0) * levels;
  double correlation = 24.0 * (per_level + 0.5 * per_level * (levels - 1.0));
  if (point.method == cases::CorrelationMethod::fft) {
    // Half a transform of complex numbers, and the samples of both quantities that it will take in.
    correlator = 24.0 * static_cast<double>(std::bit_ceil(std::max<std::size_t>(4 * lags, 256)));
    correlation = 24.0 * static_cast<double>(lags);
  }
  const double segment = std::min(static_cast<double>(cases::block_samples(point)), most_segment);
  const double correlations =
      static_cast<double>(cases::stress_correlations + (point.thermal_conductivity ? 2 : 0) + point.pairs.size());
  double particle = 52.0;  // number, position, momentum, force
  if (point.diffusion) particle += 32.0 + 16.0 * (2.0 * per_level + 1.0) * levels;
  return static_cast<double>(point.particles) * particle + (correlations + 1.0) * correlator + 2.0 * 12.0 * segment +
         static_cast<double>(cases::block_count(point)) * (correlations * correlation + 4.0 * segment);
}

DiskUse predict_disk_use(const files::GreenKuboInput& input, double /*state_bytes*/, bool /*at_most*/) {
  DiskUse use{2.0 * picture_bytes, 0.0};
  for (const auto& point : input.points) {
    const auto lags = static_cast<double>(cases::lag_count(point));
    const double samples = point.duration / cases::sample_interval(point);
    const double intervals = point.duration / (static_cast<double>(cases::interval_steps(point)) * point.step);
    constexpr double interval_bytes = sizeof(cases::EquilibriumSample);
    const double series = point.series ? samples * sizeof(cases::StressSample) : 0.0;
    use.results += point.replicas * (intervals * (interval_bytes + 16.0) + series + hdf5_bytes) + lags * 300.0;
    use.checkpoints += 2.0 * point.replicas * (checkpoint_bytes(point) + intervals * interval_bytes + series);
    add_frames(use, point.particles, point.frame_interval, point.duration);
  }
  return use;
}

DiskUse predict_disk_use(const files::BenardInput& input, double state_bytes, bool /*at_most*/) {
  DiskUse use{picture_bytes * static_cast<double>(input.points.size()), 0.0};
  for (const auto& point : input.points) {
    const auto particles = static_cast<double>(point.particles);
    const double samples = static_cast<double>(cases::interval_count(point)) * sizeof(cases::BenardSample);
    const auto cells = static_cast<double>(cases::field_cells(point).size());
    // Positions, two velocities, density and temperature of the last state; six fields; steps and times of the samples.
    use.results += particles * 64.0 + cells * 48.0 + point.replicas * (1.25 * samples + 2.0 * hdf5_bytes);
    use.checkpoints += 2.0 * point.replicas * (particles * state_bytes + samples);
    add_frames(use, point.particles, point.frame_interval, point.equilibration + point.duration);
  }
  return use;
}

DiskUse predict_disk_use(const files::BenardGridInput& input, double state_bytes, bool /*at_most*/) {
  DiskUse use{picture_bytes * static_cast<double>(input.points.size()), 0.0};
  for (const auto& point : input.points) {
    const double nodes = static_cast<double>(point.cells) * cases::flow_settings(point).cells_x;
    const double samples = static_cast<double>(cases::interval_count(point)) * sizeof(cases::BenardGridSample);
    use.results += nodes * 32.0 + samples + hdf5_bytes;
    use.checkpoints += 2.0 * (state_bytes + samples);
  }
  return use;
}

/// The unit in which work is counted: steps of particles, or of nodes.
struct WorkWords {
  std::string_view unit = "particle";
  std::string_view as_of = {};  ///< whose particles', where those of different points cost differently
  std::string_view limit = {};  ///< where a run may end before its last milestone, and mostly does
  bool counted = true;          ///< whether their number is the system's size
};

template <class Input>
WorkWords words_of_work(const Input& /*input*/) {
  return {};
}
WorkWords words_of_work(const files::WaveInput& /*input*/) { return {.as_of = ", as of atoms with range 3"}; }
WorkWords words_of_work(const files::BenardGridInput& /*input*/) {
  return {.unit = "node", .limit = "at most ", .counted = false};
}

template <class Input>
int predict(const Input& input, const std::vector<std::string>& idle_keys) {
  const int threads = input.threads > 0 ? input.threads : available_cores();
  fmt::print("{}{}{} point{}, {} thread{}:\n\n", input.title, input.title.empty() ? "" : "\n", input.points.size(),
             input.points.size() == 1 ? "" : "s", threads, threads == 1 ? "" : "s");
  print_table(rows_of(input));
  if (!idle_keys.empty()) fmt::print("\n{}\n", fmt::join(idle_keys, "\n"));

  std::unique_ptr<StatePoint> small_point;
  std::unique_ptr<StatePoint> large_point;
  bool open_ended = false;
  std::vector<double> small_least;
  std::vector<double> small_most;
  double large_least = 0.0;
  double large_most = 0.0;
  for (const auto& settings : input.points) {
    auto [point, measurable] = planned(settings);
    const auto milestones = point->milestones();
    open_ended = open_ended || milestones.size() > 1;
    const double least = static_cast<double>(milestones.front()) * point->interval_cost();
    const double most = static_cast<double>(milestones.back()) * point->interval_cost();
    const bool large = is_large(point->particles());
    auto& example = large ? large_point : small_point;
    if (!example) example = std::move(measurable);
    for (int replica = 0; replica < point->replicas(); ++replica) {
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

  const WorkWords words = words_of_work(input);
  fmt::print("\nwork: {}{} {}-steps{}\n", words.limit,
             span(count_text(work(small_least, large_least)), count_text(work(small_most, large_most))), words.unit,
             words.as_of);
  const auto say_speed = [&](const Measurement& measured, std::int64_t particles, int busy, std::string_view how) {
    fmt::print("speed: {} ns per {} and step{}, {}, measured just now on this machine{} ({} busy)\n",
               measured.speed > 0.0 ? format_plain(1e9 / measured.speed, 3) : "unknown", words.unit, words.as_of, how,
               words.counted ? fmt::format(" with N = {}", particles) : "",
               busy == 1 ? "1 thread" : fmt::format("{} threads", busy));
  };
  if (small_point) say_speed(small, small_point->particles(), copies, "one replica on each thread");
  if (large_point) say_speed(large, large_point->particles(), threads, "one replica on all threads");
  fmt::print("wall time: {}about {}\n", words.limit,
             span(duration_text(seconds(small_least, large_least)), duration_text(seconds(small_most, large_most))));
  const double state_bytes = std::max(small.state_bytes, large.state_bytes);
  const DiskUse least = predict_disk_use(input, state_bytes, false);
  const DiskUse most = predict_disk_use(input, state_bytes, true);
  fmt::print("disk: about {} of results, and up to {} of checkpoints while it runs\n",
             span(size_text(least.results), size_text(most.results)),
             span(size_text(least.checkpoints), size_text(most.checkpoints)));
  return 0;
}

}  // namespace

int check(const InputRequest& request, std::optional<files::InputKind> kind) {
  switch (kind ? *kind : files::kind_of_input(request.input, request.overrides)) {
    case files::InputKind::sweep: {
      const files::SweepInput input = files::read_sweep(request.input, request.overrides);
      return predict(input, keys_without_effect(input.points));
    }
    case files::InputKind::green_kubo:
      return predict(files::read_green_kubo(request.input, request.overrides), {});
    case files::InputKind::isomorphism:
      return predict(files::read_isomorphism(request.input, request.overrides), {});
    case files::InputKind::shear_flow:
      return predict(files::read_shear_flow(request.input, request.overrides), {});
    case files::InputKind::shear_wave:
      return predict(files::read_wave(cases::WaveQuantity::shear, request.input, request.overrides), {});
    case files::InputKind::benard:
      return predict(files::read_benard(request.input, request.overrides), {});
    case files::InputKind::benard_grid:
      return predict(files::read_benard_grid(request.input, request.overrides), {});
    case files::InputKind::temperature_wave:
      break;
  }
  return predict(files::read_wave(cases::WaveQuantity::temperature, request.input, request.overrides), {});
}

}  // namespace lucy::program

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/prediction.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <thread>

#include "lucy/files/table_text.hpp"

namespace lucy::program {

std::vector<double> recorded_durations(const cases::CouettePoint& point) {
  std::vector<double> durations = {point.duration};
  if (!point.target_relative_error || point.strain_rate == 0.0) return durations;
  const double most = point.maximum_duration > 0.0 ? point.maximum_duration : 10.0 * point.duration;
  while (durations.back() < most) durations.push_back(std::min(2.0 * durations.back(), most));
  return durations;
}

std::int64_t sample_intervals(const cases::CouettePoint& point, double duration) {
  const double interval = cases::sample_steps(point) * point.step;
  const auto whole = [interval](double time) { return static_cast<std::int64_t>(std::ceil(time / interval - 1e-6)); };
  return whole(point.equilibration) + whole(duration);
}

double interval_cost(const cases::CouettePoint& point) {
  return static_cast<double>(point.particles) * cases::sample_steps(point);
}

double time_on_workers(std::vector<double> costs, int workers) {
  std::sort(costs.begin(), costs.end(), std::greater<>());
  std::priority_queue<double, std::vector<double>, std::greater<>> busy_until;
  for (int worker = 0; worker < std::max(workers, 1); ++worker) busy_until.push(0.0);
  double end = 0.0;
  for (const double cost : costs) {
    const double finished = busy_until.top() + cost;
    busy_until.pop();
    busy_until.push(finished);
    end = std::max(end, finished);
  }
  return end;
}

int available_cores() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0.0 && seconds < 1e14)) return "unknown";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  return fmt::format("{} d {:02} h", whole / 86400, whole / 3600 % 24);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{} kB", files::format_plain(std::max(bytes, 1e3) / 1e3, 2));
  if (bytes < 1e9) return fmt::format("{} MB", files::format_plain(bytes / 1e6, 2));
  return fmt::format("{} GB", files::format_plain(bytes / 1e9, 2));
}

}  // namespace lucy::program

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "lucy/files/table_text.hpp"
#include "program/prediction.hpp"

namespace lucy::program {

namespace {

constexpr std::string_view erase_line = "\r\033[K";
constexpr auto redraw_interval = std::chrono::milliseconds(250);
constexpr int bar_width = 20;

bool terminal_can_redraw() {
  const char* kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

/// A terminal or reader that has gone is no reason to stop a sweep.
void put(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

Console::Console() : can_redraw_(terminal_can_redraw()) {}

void Console::say(std::string_view sentence) {
  const std::scoped_lock hold(lock_);
  put(fmt::format("{}lucy: {}\n{}", status_.empty() ? "" : erase_line, sentence, status_));
  std::fflush(stderr);
}

void Console::show_status(const std::string& line) {
  if (!can_redraw_) return;
  const std::scoped_lock hold(lock_);
  if (line.empty() && status_.empty()) return;
  status_ = line;
  put(fmt::format("{}{}", erase_line, line));
  std::fflush(stderr);
}

int Console::width() const {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string status_line(const RunState& state, double elapsed_seconds, int width) {
  const auto filled = static_cast<int>(std::clamp(state.fraction, 0.0, 1.0) * bar_width);
  const std::string bar = fmt::format("[{}{}]", std::string(static_cast<std::size_t>(filled), '#'),
                                      std::string(static_cast<std::size_t>(bar_width - filled), '-'));
  const std::string share = fmt::format("{:3} %", static_cast<int>(std::clamp(state.fraction, 0.0, 1.0) * 100.0));
  const std::string points =
      fmt::format("{}/{} point{}", state.points_done, state.points, state.points == 1 ? "" : "s");
  std::string label = state.label;
  std::string estimate;
  // One without an error bar is no estimate yet.
  if (std::isfinite(state.estimate.value) && std::isfinite(state.estimate.error) && state.estimate.error > 0.0) {
    estimate = fmt::format("viscosity {}", files::format_with_error(state.estimate.value, state.estimate.error));
    label += ": ";
  }
  const auto whole = [](double seconds) {  // tenths of seconds would only flicker
    return seconds < 9.5 ? fmt::format("{:.0f} s", seconds) : duration_text(seconds);
  };
  const std::string elapsed = whole(std::floor(elapsed_seconds));
  const std::string left =
      std::isfinite(state.seconds_left) ? fmt::format("{} left", whole(std::ceil(state.seconds_left))) : "";
  const std::string times = left.empty() ? elapsed : elapsed + ", " + left;

  // From the whole line down to what matters most. An estimate is never shown without its point.
  const std::vector<std::vector<std::string>> versions = {{bar, share, points, label + estimate, times},
                                                          {share, points, label + estimate, times},
                                                          {share, label + estimate, left.empty() ? elapsed : left},
                                                          {share, points, times},
                                                          {share, points}};
  std::string line;
  for (const auto& parts : versions) {
    line.clear();
    for (const auto& part : parts)
      if (!part.empty()) line += (line.empty() ? "" : "  ") + part;
    if (static_cast<int>(line.size()) < width) return line;
  }
  return line.substr(0, static_cast<std::size_t>(std::max(width - 1, 0)));
}

Progress::Progress(Console& console, std::function<std::string()> line) : console_(console) {
  if (!console_.can_redraw()) return;
  drawing_ = std::jthread([this, line = std::move(line)](const std::stop_token& end) {
    std::mutex lock;
    std::condition_variable_any wake;
    std::unique_lock hold(lock);
    while (!wake.wait_for(hold, end, redraw_interval, [&end] { return end.stop_requested(); }))
      console_.show_status(line());
  });
}

Progress::~Progress() {
  if (drawing_.joinable()) {
    drawing_.request_stop();
    drawing_.join();
  }
  console_.show_status("");
}

}  // namespace lucy::program

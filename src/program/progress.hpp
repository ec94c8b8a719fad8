// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a person sees while a sweep runs: sentences, and on a terminal one status line below them, drawn again and
// again.
#pragma once

#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "program/scheduler.hpp"

namespace lucy::program {

/// Standard error, shared by threads. Sentences go above the status line.
class Console {
 public:
  Console();

  /// Whether standard error is a terminal that can draw a line anew.
  bool can_redraw() const { return can_redraw_; }
  /// Prints "lucy: " and the sentence.
  void say(std::string_view sentence);
  /// Replaces the status line; empty: removes it. Nothing happens where lines cannot be drawn anew.
  void show_status(const std::string& line);
  /// Columns of the terminal.
  int width() const;

 private:
  bool can_redraw_;
  std::mutex lock_;
  std::string status_;
};

/// "[####------]  41 %  2/5 points  N = 1024, E/N = 1, rate 0.1: viscosity 2.66(3)  1 min 05 s, 1 min 33 s left",
/// shortened from the middle outwards until it fits.
std::string status_line(const RunState& state, double elapsed_seconds, int width);

/// Draws `line()` several times a second while it lives, and removes the line at its end. Does nothing where lines
/// cannot be drawn anew.
class Progress {
 public:
  Progress(Console& console, std::function<std::string()> line);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  Console& console_;
  std::jthread drawing_;
};

}  // namespace lucy::program

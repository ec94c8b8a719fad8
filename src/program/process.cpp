// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>
#include <string_view>

namespace lucy::program {

namespace {

using Clock = std::chrono::steady_clock;

/// One stream of a command, read by us.
struct Pipe {
  std::array<int, 2> ends{-1, -1};  // read, write
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
};

constexpr double longest_look = 0.2;  // seconds between questions whether to go on

/// Reads both streams until the command closes them. False: the time is over. `look` is called in between.
bool collect(Pipe& out, Pipe& err, std::string& output, std::string& errors, double seconds,
             const std::function<void()>& look) {
  const auto begin = Clock::now();
  while (out.ends[0] >= 0 || err.ends[0] >= 0) {
    const double left = seconds - std::chrono::duration<double>(Clock::now() - begin).count();
    if (left <= 0.0) return false;
    look();
    std::array<pollfd, 2> streams = {pollfd{out.ends[0], POLLIN, 0}, pollfd{err.ends[0], POLLIN, 0}};
    const int wait = static_cast<int>(1e3 * std::min(left, longest_look)) + 1;
    if (::poll(streams.data(), streams.size(), wait) < 0 && errno != EINTR) return false;
    for (auto* stream : {&out, &err}) {
      if (streams[stream == &out ? 0 : 1].revents == 0) continue;
      std::array<char, 4096> part;
      const ssize_t got = ::read(stream->ends[0], part.data(), part.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0)
        stream->close(0);
      else
        (stream == &out ? output : errors).append(part.data(), static_cast<std::size_t>(got));
    }
  }
  return true;
}

/// The last line that says something.
std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (has_letter(line)) last = line;
  while (!last.empty() && last.back() == '\r') last.pop_back();
  return last;
}

bool is_plain(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view("_-./=+:,@%").find(c) != std::string_view::npos;
}

}  // namespace

bool has_letter(std::string_view line) {
  return std::ranges::any_of(line, [](unsigned char c) { return std::isalpha(c) != 0; });
}

CommandResult run_command(const std::vector<std::string>& words, double seconds, const CommandSettings& settings) {
  CommandResult result;
  Pipe out;
  Pipe err;
  if (out.ends[0] < 0 || err.ends[0] < 0) {
    result.complaint = std::strerror(errno);
    return result;
  }
  Pipe refusal;  // errno of a command that could not be started
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::string folder = settings.folder.string();
  const pid_t self = ::getpid();
  const pid_t process = ::fork();
  if (process == 0) {
    // Between fork and exec: system calls alone.
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    const bool ready = ::getppid() == self && nothing >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
                       ::dup2(out.ends[1], STDOUT_FILENO) >= 0 && ::dup2(err.ends[1], STDERR_FILENO) >= 0 &&
                       (folder.empty() || ::chdir(folder.c_str()) == 0);
    if (ready) ::execvp(arguments.front(), arguments.data());
    const int why = errno;
    [[maybe_unused]] const ssize_t told = ::write(refusal.ends[1], &why, sizeof why);
    ::_exit(127);
  }
  const int no_fork = errno;
  for (Pipe* pipe : {&out, &err, &refusal}) pipe->close(1);
  int why = no_fork;
  if (process < 0 || ::read(refusal.ends[0], &why, sizeof why) == sizeof why) {
    if (process > 0) ::waitpid(process, nullptr, 0);
    result.complaint = std::strerror(why);
    return result;
  }

  const auto ask_to_end = [&] {
    if (settings.goes_on && !settings.goes_on()) ::kill(process, SIGTERM);
  };
  const bool in_time = collect(out, err, result.output, result.errors, seconds, ask_to_end);
  if (!in_time) ::kill(process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  result.succeeded = in_time && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (result.succeeded) return result;
  if (!in_time)
    result.complaint = fmt::format("it did not end within {:.0f} s", seconds);
  else if (WIFSIGNALED(status))
    result.complaint = fmt::format("it was ended by signal {}", WTERMSIG(status));
  else if (result.complaint = last_line(result.errors); result.complaint.empty())
    result.complaint = fmt::format("it ended with exit code {}", WEXITSTATUS(status));
  return result;
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) {
    bool plain = !word.empty();
    for (const char c : word) plain = plain && is_plain(c);
    std::string quoted = plain ? word : "'";
    if (!plain) {
      for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
      quoted += '\'';
    }
    line += (line.empty() ? "" : " ") + quoted;
  }
  return line;
}

}  // namespace lucy::program

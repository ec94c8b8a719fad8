// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Threads that share the work inside one system. The work is cut into parts by the particles, never by the number of
// threads, and partial results are added in the order of the parts: every team size gives the same bits.
#pragma once

#include <cstddef>

namespace lucy {

class Team {
 public:
  explicit Team(int threads = 1) : threads_(threads < 1 ? 1 : threads) {}

  int threads() const { return threads_; }

  /// Calls work(part) for part = 0 .. parts - 1, each exactly once, in no stated order. `work` must not throw.
  template <class Work>
  void share(std::ptrdiff_t parts, const Work& work) const {
    if (threads_ == 1 || parts < 2) {
      for (std::ptrdiff_t part = 0; part < parts; ++part) work(part);
      return;
    }
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 1)
    for (std::ptrdiff_t part = 0; part < parts; ++part) work(part);
  }

 private:
  int threads_;
};

}  // namespace lucy

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the state points of all cases have in common. A case has a Point (the settings of one row), a Run (one replica
// on its way, whose record() is what was measured) and a Result, which is made of the records of all replicas.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "program/experiment.hpp"

namespace lucy::program {

template <class Run>
class CaseReplica final : public Replica {
 public:
  template <class Point>
  CaseReplica(const Point& point, int number, int threads) : run_(point, number, threads) {}

  void advance() override {
    if constexpr (requires { run_.advance_one_interval(); })
      run_.advance_one_interval();
    else
      run_.advance_one_sample();
  }
  std::int64_t intervals_done() const override { return run_.intervals_done(); }
  bool frame_due() const override {
    if constexpr (requires { run_.frame_due(); }) return run_.frame_due();
    return false;
  }
  cases::Frame frame() const override {
    if constexpr (requires { run_.frame(); }) return run_.frame();
    return {};
  }
  void save(ArchiveWriter& archive) const override { run_.save(archive); }
  void load(ArchiveReader& archive) override { run_.load(archive); }

  const Run& run() const { return run_; }

 private:
  Run run_;
};

template <class Point, class Run, class Result>
class CaseStatePoint : public StatePoint {
 public:
  using Record = std::remove_cvref_t<decltype(std::declval<const Run&>().record())>;

  /// Of a replica on its way, as the system counts them for large ones: those of one system of atoms.
  static constexpr double bytes_per_particle = 275.0;

  /// `series`: where the point's H5MD file goes, if it has one.
  explicit CaseStatePoint(const Point& settings, std::filesystem::path series = {},
                          const files::H5mdAuthorship& authorship = {})
      : settings_(settings), series_(std::move(series)), authorship_(authorship) {}

  std::int64_t particles() const final { return settings_.particles; }
  int replicas() const final { return settings_.replicas; }
  bool records_frames() const final {
    if constexpr (requires(Point point) { point.frame_interval; }) return settings_.frame_interval > 0.0;
    return false;
  }
  std::unique_ptr<Replica> start(int replica, int threads) const final {
    return std::make_unique<CaseReplica<Run>>(settings_, replica, threads);
  }

  /// Unless a case has one, there is no estimate on the way.
  void note(int /*number*/, const Replica& /*replica*/) override {}
  statistics::Estimate estimate() const override { return {not_a_number, not_a_number, not_a_number, 0}; }
  void forget_notes() override {}

  bool conclude(std::size_t stage, std::span<const Arrived> replicas) final {
    std::vector<Record> records;
    double seconds = 0.0;
    for (const Arrived& arrived : replicas) {
      records.push_back(run_of(*arrived.replica).record());
      seconds += arrived.seconds;
    }
    std::optional<Result> result = result_at(stage, replicas, records);
    if (!result) return false;
    result_ = std::move(*result);
    seconds_ = seconds;
    return true;
  }

  void fail(int replica, const std::string& message) final {
    result_ = failed_result(replicas() > 1 ? fmt::format("replica {}: {}", replica + 1, message) : message);
    seconds_ = not_a_number;
  }

  /// Once it is concluded or has failed.
  const Result& result() const { return result_; }
  double seconds() const { return seconds_; }

 protected:
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  static const Run& run_of(const Replica& replica) { return static_cast<const CaseReplica<Run>&>(replica).run(); }

  /// The result at milestones()[stage], its H5MD file being on disk; nothing when the point is to go on.
  virtual std::optional<Result> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                          std::span<const Record> records) = 0;
  virtual Result failed_result(const std::string& reason) const = 0;

  const Point& settings() const { return settings_; }
  const std::filesystem::path& series() const { return series_; }
  const files::H5mdAuthorship& authorship() const { return authorship_; }

 private:
  Point settings_;
  std::filesystem::path series_;
  files::H5mdAuthorship authorship_;
  Result result_;
  double seconds_ = 0.0;
};

/// A state point with an estimate on the way, made of the latest records of its replicas.
template <class Point, class Run, class Result>
class NotingStatePoint : public CaseStatePoint<Point, Run, Result> {
 public:
  using typename CaseStatePoint<Point, Run, Result>::Record;

  explicit NotingStatePoint(const Point& settings, std::filesystem::path series = {},
                            const files::H5mdAuthorship& authorship = {})
      : CaseStatePoint<Point, Run, Result>(settings, std::move(series), authorship),
        notes_(static_cast<std::size_t>(settings.replicas)) {}

  void note(int number, const Replica& replica) final {
    const std::scoped_lock lock(notes_lock_);
    notes_[static_cast<std::size_t>(number)] = this->run_of(replica).record();
  }

  void forget_notes() final {
    const std::scoped_lock lock(notes_lock_);
    for (Record& record : notes_) record = {};
  }

 protected:
  /// The records of the replicas that have measured something: `measured(record)`.
  template <class Measured>
  std::vector<Record> noted(Measured measured) const {
    std::vector<Record> records;
    const std::scoped_lock lock(notes_lock_);
    for (const Record& record : notes_)
      if (measured(record)) records.push_back(record);
    return records;
  }

 private:
  mutable std::mutex notes_lock_;
  std::vector<Record> notes_;  // by replica
};

}  // namespace lucy::program

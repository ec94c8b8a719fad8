// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/replica_task.hpp"

#include <fmt/format.h>

#include <utility>

#include "lucy/archive.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/checkpoint.hpp"

namespace lucy::program {

namespace {

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

struct Head {
  std::int32_t stage;
  std::int64_t frames;
  std::int64_t intervals_done;
  double seconds;
};

Head read_head(ArchiveReader& archive) {
  Head head{};
  head.stage = archive.get<std::int32_t>();
  head.frames = archive.get<std::int64_t>();
  head.intervals_done = archive.get<std::int64_t>();
  head.seconds = archive.get<double>();
  return head;
}

}  // namespace

ReplicaHistory read_history(const ReplicaFiles& files) {
  auto read = files::read_checkpoint(files.checkpoint, files.identity);
  ReplicaHistory history;
  history.rejected = std::move(read.rejected);
  if (!read.payload) return history;
  ArchiveReader archive(*read.payload);
  try {
    const Head head = read_head(archive);
    history.exists = true;
    history.stage = head.stage;
    history.intervals_done = head.intervals_done;
  } catch (const RunFailed& failure) {
    history.rejected.push_back(
        fmt::format("the checkpoint {} cannot be used: {}", files.checkpoint.string(), failure.what()));
  }
  return history;
}

ReplicaTask::ReplicaTask(const StatePoint& point, int number, int threads, ReplicaFiles files)
    : point_(point),
      number_(number),
      threads_(threads),
      files_(std::move(files)),
      replica_(point.start(number, threads)) {}

std::optional<std::string> ReplicaTask::take_up() {
  if (files_.frames) frames_.emplace(*files_.frames, point_.particles(), !replica_->frame().internal_energy.empty());
  std::optional<std::string> told;
  if (const auto read = files::read_checkpoint(files_.checkpoint, files_.identity); read.payload) {
    try {
      load(*read.payload);
      last_checkpoint_ = Clock::now();
      return told;
    } catch (const RunFailed& failure) {
      told = fmt::format("{} begins again, since the checkpoint {} could not be taken up: {}",
                         fmt::format("replica {}", number_ + 1), files_.checkpoint.string(), failure.what());
      replica_ = point_.start(number_, threads_);
      saved_intervals_ = -1;
      seconds_ = 0.0;
    }
  }
  if (frames_) frames_->truncate(0);
  record_frame();
  last_checkpoint_ = Clock::now();
  return told;
}

void ReplicaTask::load(const std::vector<std::byte>& payload) {
  ArchiveReader archive(payload);
  const Head head = read_head(archive);
  replica_->load(archive);
  if (frames_) frames_->truncate(head.frames);
  saved_intervals_ = replica_->intervals_done();
  saved_stage_ = head.stage;
  seconds_ = head.seconds;
}

void ReplicaTask::record_frame() {
  if (frames_ && replica_->frame_due()) frames_->append(replica_->frame());
}

void ReplicaTask::checkpoint(std::int32_t stage) {
  if (saved_intervals_ == replica_->intervals_done() && saved_stage_ == stage) return;
  const auto begin = Clock::now();
  if (frames_) frames_->synchronise();
  ArchiveWriter archive;
  archive.put(stage);
  archive.put(frames_ ? frames_->count() : std::int64_t{0});
  archive.put(replica_->intervals_done());
  archive.put(seconds());
  replica_->save(archive);
  files::write_checkpoint(files_.checkpoint, archive.bytes(), files_.identity);
  saved_intervals_ = replica_->intervals_done();
  saved_stage_ = stage;
  last_checkpoint_ = Clock::now();
  seconds_to_write_ = seconds_between(begin, last_checkpoint_);
}

double ReplicaTask::seconds_since_checkpoint() const { return seconds_between(last_checkpoint_, Clock::now()); }

void ReplicaTask::start_clock() { clock_started_ = Clock::now(); }

void ReplicaTask::stop_clock() {
  seconds_ = seconds();
  clock_started_.reset();
}

double ReplicaTask::seconds() const {
  return seconds_ + (clock_started_ ? seconds_between(*clock_started_, Clock::now()) : 0.0);
}

}  // namespace lucy::program

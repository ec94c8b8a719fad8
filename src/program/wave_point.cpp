// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/wave_point.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "lucy/files/wave_h5md.hpp"
#include "lucy/files/wave_input.hpp"
#include "lucy/files/wave_text.hpp"

namespace lucy::program {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// What a step of a particle costs, measured on one core in units of an atom's with range 3: in proportion to 12 + n h^2
// (the first for everything but pairs), more passes for smooth particles, and a kernel of two pieces.
constexpr double beside_pairs = 12.0;
constexpr double fluid_cost = 2.1;
constexpr double transport_cost = 4.2;
constexpr double monaghan_cost = 2.0;

class WaveReplica final : public Replica {
 public:
  WaveReplica(const cases::WavePoint& point, int number, int threads) : run_(point, number, threads) {}

  void advance() override { run_.advance_one_interval(); }
  std::int64_t intervals_done() const override { return run_.intervals_done(); }
  bool frame_due() const override { return run_.frame_due(); }
  cases::Frame frame() const override { return run_.frame(); }
  void save(ArchiveWriter& archive) const override { run_.save(archive); }
  void load(ArchiveReader& archive) override { run_.load(archive); }

  const cases::WaveRun& run() const { return run_; }

 private:
  cases::WaveRun run_;
};

}  // namespace

WaveStatePoint::WaveStatePoint(const cases::WavePoint& settings, std::filesystem::path frames,
                               const files::H5mdAuthorship& authorship)
    : settings_(settings), frames_(std::move(frames)), authorship_(authorship) {}

std::string WaveStatePoint::label() const { return files::wave_label(settings_); }

std::string WaveStatePoint::identity() const {
  files::WaveInput alone;
  alone.quantity = settings_.quantity;
  alone.points = {settings_};
  return std::string(files::command_name(settings_.quantity)) + '\n' + files::wave_resolved_toml(alone);
}

double WaveStatePoint::interval_cost() const {
  const auto pairs = [](double density, double range) { return beside_pairs + density * range * range; };
  double cost = pairs(settings_.density, settings_.range) / pairs(1.0, 3.0);
  if (settings_.reading == motion::Reading::spam)
    cost *= cases::fluid_of(settings_).transport.none() ? fluid_cost : transport_cost;
  if (settings_.weight == kernel::WeightName::monaghan) cost *= monaghan_cost;
  return cost * static_cast<double>(settings_.particles) *
         static_cast<double>(cases::wave_schedule(settings_).steps_per_interval());
}

std::unique_ptr<Replica> WaveStatePoint::start(int replica, int threads) const {
  return std::make_unique<WaveReplica>(settings_, replica, threads);
}

statistics::Estimate WaveStatePoint::estimate() const { return {not_a_number, not_a_number, not_a_number, 0}; }

bool WaveStatePoint::conclude(std::size_t /*stage*/, std::span<const Arrived> replicas) {
  std::vector<cases::WaveRecord> records;
  std::vector<const files::FrameSpool*> frames;
  for (const Arrived& arrived : replicas) {
    records.push_back(static_cast<const WaveReplica&>(*arrived.replica).run().record());
    frames.push_back(arrived.frames);
    seconds_ += arrived.seconds;
  }
  if (records_frames()) files::write_h5md(frames_, settings_, records, frames, authorship_);
  result_ = cases::summarize(settings_, records);
  return true;
}

void WaveStatePoint::fail(int replica, const std::string& message) {
  result_ = {};
  result_.row = cases::failed_row(
      settings_, settings_.replicas > 1 ? fmt::format("replica {}: {}", replica + 1, message) : message);
  seconds_ = not_a_number;
}

}  // namespace lucy::program

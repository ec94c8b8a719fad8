// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/wave_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "lucy/statistics/decay_comparison.hpp"
#include "lucy/statistics/jackknife.hpp"
#include "lucy/statistics/running_integral.hpp"
#include "lucy/statistics/wave_decay.hpp"

namespace lucy::cases {

namespace {

using statistics::BlockAverages;
using statistics::DecayForm;
using statistics::DecayingWave;
using statistics::Estimate;
using Numbers = std::vector<double>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown{not_a_number, not_a_number, not_a_number, 0};
constexpr double well_begun = 0.8;  // of the amplitude at the start

Estimate times(double factor, Estimate estimate) {
  estimate.value *= factor;
  estimate.error *= std::abs(factor);
  return estimate;
}

/// Means over replicas, or over all but one, of a number at every sample.
class Mean {
 public:
  Mean(std::span<const WaveRecord> replicas, const std::function<double(const WaveSample&)>& number)
      : averages_(gathered(replicas, number), Numbers(replicas.size(), 1.0)), replicas_(replicas.size()) {}

  /// `replica`: left out; their number: none.
  Numbers without(std::size_t replica) const {
    return replica == replicas_ ? averages_.mean() : averages_.mean_without(replica);
  }
  Numbers of_all() const { return averages_.mean(); }

 private:
  static std::vector<Numbers> gathered(std::span<const WaveRecord> replicas,
                                       const std::function<double(const WaveSample&)>& number) {
    std::vector<Numbers> series;
    for (const WaveRecord& record : replicas) {
      Numbers& values = series.emplace_back();
      for (const WaveSample& sample : record.samples) values.push_back(number(sample));
    }
    return series;
  }

  BlockAverages averages_;
  std::size_t replicas_;
};

/// With the error over replicas; `value` of a mean over replicas, the number being that of the one left out. A single
/// replica gives no error.
Estimate over_replicas(std::size_t replicas, const std::function<double(std::size_t)>& value) {
  if (replicas < 2) return {value(replicas), not_a_number, not_a_number, 0};
  return statistics::jackknife(replicas, value);
}

double mean_of(const Numbers& values, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - begin);
}

/// How many samples the parts are taken from.
std::size_t samples_of_parts(const DecayingWave& wave) {
  const Numbers mean = wave.mean();
  const Numbers errors = wave.errors();
  std::size_t count = 1;
  while (count < mean.size()) {
    const double noise = std::isfinite(errors[count]) ? parts_end_at_errors * errors[count] : 0.0;
    if (mean[count] < std::max(parts_end_at * mean.front(), noise)) break;
    ++count;
  }
  return count;
}

struct Parts {
  double operator_ = 0.0;
  double carried = 0.0;
  double total = 0.0;
};

/// Of mean curves that hold so many samples.
Parts parts_of(const Numbers& time, const Numbers& amplitude, const Numbers& by_operator, const Numbers& carried,
               double wave_vector, std::size_t samples) {
  const auto integral = [&](const Numbers& values) {
    return statistics::running_integral(std::span(time).first(samples), std::span(values).first(samples)).back();
  };
  const double scale = 1.0 / (wave_vector * wave_vector * integral(amplitude));
  return {0.0 - scale * integral(by_operator), 0.0 - scale * integral(carried),
          scale * (amplitude.front() - amplitude[samples - 1])};
}

/// The rate that the constitutive law asks for while the density is uniform still, over k^2: what conducts then is not
/// kappa/(rho c_P) but kappa/(rho c_V), and c_V = 1 where there is an entropy.
double diffusivity_at_start(const WavePoint& point) {
  return (point.quantity == WaveQuantity::shear ? point.viscosity : point.conductivity) / point.density;
}

void estimate_parts(const DecayingWave& wave, std::span<const WaveRecord> replicas, WaveRow& row) {
  const std::size_t samples = samples_of_parts(wave);
  row.parts_until = wave.times()[samples - 1];
  const std::size_t count = replicas.size();
  const Mean by_operator(replicas, [](const WaveSample& sample) { return sample.parts[part_operator]; });
  const Mean carried(replicas, [](const WaveSample& sample) { return sample.parts[part_carried]; });
  const Mean noise(replicas, [](const WaveSample& sample) { return sample.particle_noise; });
  const Mean pressure(replicas, [](const WaveSample& sample) { return sample.pressure; });
  const auto set = [&](std::size_t quantity, const std::function<double(std::size_t)>& value) {
    row.estimates[quantity] = over_replicas(count, value);
  };
  set(wave_quantity("particle_noise"), [&](std::size_t r) { return mean_of(noise.without(r), 0, samples); });
  set(wave_quantity("pressure"), [&](std::size_t r) { return mean_of(pressure.without(r), 0, samples); });
  if (row.prescribed > 0.0) {
    set(wave_quantity("operator_factor"), [&](std::size_t r) {
      const double rate = -by_operator.without(r).front() / wave.mean_without(r).front();
      return rate / (row.wave_vector * row.wave_vector * diffusivity_at_start(row.settings));
    });
  }
  if (samples < 2) return;
  std::vector<Parts> parts;
  for (std::size_t r = 0; r <= count; ++r) {
    const bool none_left = count == 1 && r == 0;
    parts.push_back(none_left ? Parts{}
                              : parts_of(wave.times(), wave.mean_without(r), by_operator.without(r), carried.without(r),
                                         row.wave_vector, samples));
  }
  set(wave_quantity("operator"), [&](std::size_t r) { return parts[r].operator_; });
  set(wave_quantity("carried"), [&](std::size_t r) { return parts[r].carried; });
  set(wave_quantity("total"), [&](std::size_t r) { return parts[r].total; });
  set(wave_quantity("rest"), [&](std::size_t r) { return parts[r].total - parts[r].operator_ - parts[r].carried; });
}

std::vector<LocalDiffusivity> local_diffusivities(const DecayingWave& wave, std::span<const WaveRecord> replicas,
                                                  double wave_vector) {
  const Mean noise(replicas, [](const WaveSample& sample) { return sample.particle_noise; });
  std::vector<LocalDiffusivity> result;
  for (const statistics::LocalRate& rate : statistics::local_rates(wave)) {
    const auto place = [&](double time) {
      return static_cast<std::size_t>(std::ranges::lower_bound(wave.times(), time) - wave.times().begin());
    };
    LocalDiffusivity local;
    local.begin = rate.begin;
    local.end = rate.end;
    local.amplitude = rate.amplitude;
    local.gradient = times(wave_vector, rate.amplitude);
    local.value = times(1.0 / (wave_vector * wave_vector), rate.rate);
    local.particle_noise = over_replicas(replicas.size(), [&](std::size_t r) {
      return mean_of(noise.without(r), place(rate.begin), place(rate.end) + 1);
    });
    result.push_back(local);
  }
  return result;
}

/// Of all forms, the likeliest first: how far each is behind it.
std::array<Estimate, statistics::decay_forms.size()> behind_the_likeliest(
    const statistics::DecayComparison& comparison) {
  std::array<Estimate, statistics::decay_forms.size()> behind;
  behind.fill(unknown);
  if (!comparison.by_likelihood) return behind;
  const auto difference = [&](DecayForm first, DecayForm second) -> Estimate {
    for (const auto& each : comparison.differences) {
      if (each.first == first && each.second == second) return each.log_likelihood;
      if (each.first == second && each.second == first) return times(-1.0, each.log_likelihood);
    }
    return {0.0, 0.0, 0.0, 0};  // of a form with itself
  };
  const auto likeliest = std::ranges::find_if(statistics::decay_forms, [&](DecayForm form) {
    return std::ranges::all_of(statistics::decay_forms,
                               [&](DecayForm other) { return difference(form, other).value >= 0.0; });
  });
  if (likeliest == statistics::decay_forms.end()) return behind;
  for (std::size_t f = 0; f < behind.size(); ++f) behind[f] = difference(*likeliest, statistics::decay_forms[f]);
  return behind;
}

void compare_forms(const DecayingWave& wave, WaveResult& result) {
  WaveRow& row = result.row;
  const statistics::DecayComparison comparison = statistics::compare_decay_forms(wave);
  const auto behind = behind_the_likeliest(comparison);
  const double k = row.wave_vector;
  const double density = row.settings.density;
  const bool momentum = row.settings.quantity == WaveQuantity::shear;
  row.preferred = comparison.preferred;
  row.by_likelihood = comparison.by_likelihood;
  for (std::size_t f = 0; f < comparison.fits.size(); ++f) {
    const statistics::FormFit& fit = comparison.fits[f];
    WaveForm form;
    form.form = fit.form;
    form.amplitude = fit.amplitude;
    form.diffusivity = times(1.0 / (k * k), fit.rate);
    form.yield_amplitude = fit.yield_amplitude;
    form.relaxation_time = fit.memory_time;
    form.yield_stress = momentum ? times(std::numbers::pi * density / (4.0 * k), fit.deceleration) : unknown;
    form.modulus = unknown;
    if (momentum) {
      // The square of the natural frequency, with its error by differentials.
      const Estimate& frequency = fit.natural_frequency;
      form.modulus = times(density * frequency.value / (k * k), frequency);
      form.modulus.error *= 2.0;
    }
    form.relative_residual = fit.relative_residual;
    form.residual_over_error = fit.residual_over_error;
    form.behind = behind[f];
    form.preferred = fit.form == comparison.preferred;
    if (form.preferred) {
      row.estimates[wave_quantity("fitted")] = form.diffusivity;
      for (const double time : wave.times())
        result.curve.fit.push_back(statistics::decay_form(fit.form, fit.parameters, time));
    }
    if (fit.form == DecayForm::yielding) row.estimates[wave_quantity("yield_stress")] = form.yield_stress;
    if (fit.form == DecayForm::viscoelastic) {
      row.estimates[wave_quantity("modulus")] = form.modulus;
      row.estimates[wave_quantity("relaxation_time")] = form.relaxation_time;
    }
    result.forms.push_back(form);
  }
}

void fill_curve(const DecayingWave& wave, std::span<const WaveRecord> replicas, WaveCurve& curve) {
  const statistics::ReplicaMeanCurve mean = statistics::replica_mean_curve(wave);
  curve.time = mean.times;
  curve.mean = mean.mean;
  curve.error = mean.error;
  curve.particle_noise = Mean(replicas, [](const WaveSample& sample) { return sample.particle_noise; }).of_all();
  for (std::size_t part = 0; part < wave_parts; ++part)
    curve.parts[part] = Mean(replicas, [part](const WaveSample& sample) { return sample.parts[part]; }).of_all();
}

WaveRow empty_row(const WavePoint& point) {
  WaveRow row;
  row.settings = point;
  row.wave_vector = wave_vector(point);
  row.sample_interval = wave_schedule(point).sample_interval(point);
  row.prescribed = prescribed_diffusivity(point);
  row.imposed_amplitude = row.parts_until = row.worst_energy_error = not_a_number;
  row.estimates.fill(unknown);
  return row;
}

void conclude(const DecayingWave& wave, WaveRow& row) {
  const Numbers mean = wave.mean();
  const double least = *std::ranges::min_element(mean) / mean.front();
  if (wave.replicas() < 2) row.status = RowStatus::too_short;
  if (!(mean.front() > 0.0)) {
    row.status = RowStatus::too_short;
    row.warnings.emplace_back(
        "The wave is lost in the noise of the particles from the start: use a larger wave.amplitude, or more of "
        "run.replicas.");
  } else if (!(least < well_begun)) {
    row.status = RowStatus::too_short;
    row.warnings.push_back(fmt::format(
        "The amplitude fell to {:.0f} % of its start and no further: how it decays cannot be told; lengthen "
        "run.duration.",
        100.0 * least));
  } else if (std::isnan(row.estimates[wave_quantity("integral")].value)) {
    row.warnings.emplace_back(
        "There is no value by the integral: the wave rings to the end of the record, or its decay is lost in noise.");
  }
}

}  // namespace

std::string_view rest_name(WaveQuantity quantity) {
  return quantity == WaveQuantity::shear ? "pressure_forces" : "heating";
}

WaveResult summarize(const WavePoint& point, std::span<const WaveRecord> all_replicas) {
  const bool alike = all_replicas.size() > 1 && point.reading == motion::Reading::spam && all_replicas_alike(point);
  const auto replicas = alike ? all_replicas.first(1) : all_replicas;
  WaveResult result;
  WaveRow& row = result.row;
  row = empty_row(point);
  std::vector<Numbers> amplitudes;
  row.imposed_amplitude = row.worst_energy_error = 0.0;
  for (const WaveRecord& record : replicas) {
    Numbers& amplitude = amplitudes.emplace_back();
    for (const WaveSample& sample : record.samples) amplitude.push_back(sample.amplitude);
    row.imposed_amplitude += record.imposed_amplitude / static_cast<double>(replicas.size());
    row.worst_energy_error = std::max(row.worst_energy_error, record.worst_energy_error);
    row.subdivided_steps += record.subdivided_steps;
  }
  const DecayingWave wave(row.sample_interval, std::move(amplitudes));
  estimate_parts(wave, replicas, row);
  result.local = local_diffusivities(wave, replicas, row.wave_vector);
  const statistics::IntegralRate integral = statistics::integral_rate(wave, row.imposed_amplitude);
  row.estimates[wave_quantity("integral")] = times(1.0 / (row.wave_vector * row.wave_vector), integral.rate);
  row.estimates[wave_quantity("tail_share")] = integral.tail_share;
  compare_forms(wave, result);
  fill_curve(wave, replicas, result.curve);
  conclude(wave, row);
  if (alike)
    row.warnings.emplace_back(
        "All replicas are the same, since start.disorder and start.noise are 0: the first alone counts.");
  return result;
}

WaveRow failed_row(const WavePoint& point, std::string message) {
  WaveRow row = empty_row(point);
  row.status = RowStatus::failed;
  row.failure = std::move(message);
  return row;
}

}  // namespace lucy::cases

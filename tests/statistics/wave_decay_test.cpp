// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/wave_decay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "statistics/noisy_wave.hpp"

namespace lucy::statistics {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// One replica without noise.
DecayingWave exact(DecayForm form, const DecayParameters& truth, double interval, std::size_t samples) {
  return NoisyWave{form, truth, interval, samples, 1, 0.0}.realisation(1);
}

std::string refusal(double interval, const std::vector<std::vector<double>>& amplitudes) {
  try {
    const DecayingWave wave(interval, amplitudes);
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "";
}

TEST(WaveDecay, RefusesWhatIsNoWave) {
  const std::vector<double> sound(8, 1.0);
  std::vector<double> broken = sound;
  broken[5] = not_a_number;
  EXPECT_EQ(refusal(0.5, {sound, sound}), "");
  EXPECT_NE(refusal(0.5, {sound, broken})
                .find("replica 1 of a decaying wave has an amplitude that is not finite, "
                      "sample 5"),
            std::string::npos);
  broken[5] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(0.5, {broken}).find("replica 0"), std::string::npos);
  EXPECT_NE(refusal(0.5, {sound, std::vector<double>(9, 1.0)}).find("replica 1 of a decaying wave has 9"),
            std::string::npos);
  EXPECT_NE(refusal(0.5, {std::vector<double>(7, 1.0)}).find("at least 8"), std::string::npos);
  EXPECT_NE(refusal(0.5, {}).find("at least one replica"), std::string::npos);
  for (const double interval : {0.0, -1.0, not_a_number})
    EXPECT_NE(refusal(interval, {sound}).find("an interval above zero"), std::string::npos);
}

TEST(WaveDecay, RefusesLevelsThatDoNotFallFromBelowOneToAboveZero) {
  const DecayingWave wave = exact(DecayForm::exponential, {1.0, 0.1, 0.0, 0.0}, 1.0, 20);
  for (const std::vector<double>& levels :
       {std::vector<double>{1.0, 0.5}, {0.5, 0.5}, {0.5, 0.6}, {0.5, 0.0}, {0.5, not_a_number}})
    EXPECT_THROW(local_rates(wave, levels), std::invalid_argument);
}

TEST(WaveDecay, TheMeanCurveHasTheErrorOfTheMeanAtEveryTime) {
  std::vector<std::vector<double>> amplitudes = {std::vector<double>(8, 1.0), std::vector<double>(8, 2.0),
                                                 std::vector<double>(8, 6.0)};
  amplitudes[2][7] = 3.0;
  const ReplicaMeanCurve curve = replica_mean_curve({0.25, amplitudes});
  ASSERT_EQ(curve.times.size(), 8u);
  EXPECT_EQ(curve.times[7], 1.75);
  EXPECT_NEAR(curve.mean[0], 3.0, 1e-15);
  EXPECT_NEAR(curve.error[0], student_factor(2) * std::sqrt(14.0 / 6.0), 1e-13);
  EXPECT_NEAR(curve.mean[7], 2.0, 1e-15);
  EXPECT_NEAR(curve.error[7], student_factor(2) * std::sqrt(2.0 / 6.0), 1e-13);
}

TEST(WaveDecay, LocalRatesOfAnExponentialAreItsRateInEveryWindow) {
  const double rate = 0.04;
  const std::vector<LocalRate> rates = local_rates(exact(DecayForm::exponential, {0.3, rate, 0.0, 0.0}, 0.25, 400));
  ASSERT_EQ(rates.size(), window_levels.size());
  double level = 1.0, begin = 0.0;
  for (std::size_t k = 0; k < rates.size(); ++k) {
    EXPECT_NEAR(rates[k].rate.value, rate, 1e-8);
    EXPECT_NEAR(rates[k].amplitude.value, 0.3 * std::exp(-rate * rates[k].time), 1e-8);
    EXPECT_TRUE(std::isnan(rates[k].rate.error)) << "a single replica has no error";
    EXPECT_TRUE(std::isnan(rates[k].amplitude.error));
    EXPECT_NEAR(rates[k].begin, -std::log(level) / rate, 0.26);
    EXPECT_NEAR(rates[k].end, -std::log(window_levels[k]) / rate, 0.26);
    EXPECT_NEAR(rates[k].time, 0.5 * (rates[k].begin + rates[k].end), 1e-12);
    EXPECT_GE(rates[k].begin, begin);
    begin = rates[k].end;
    level = window_levels[k];
  }
}

TEST(WaveDecay, LocalRatesRiseAsAYieldingWaveFalls) {
  const DecayParameters truth{1.0, 0.03, 0.03 * 0.1, 0.0};
  const std::vector<LocalRate> rates = local_rates(exact(DecayForm::yielding, truth, 0.1, 1000));
  ASSERT_EQ(rates.size(), window_levels.size());
  for (const LocalRate& each : rates)
    EXPECT_NEAR(each.rate.value / (truth.rate * (1.0 + truth.yield_amplitude() / each.amplitude.value)), 1.0, 0.02);
}

TEST(WaveDecay, WindowsFollowTheFirstDescentOfAWaveThatRings) {
  // omega = 0.2: it crosses zero near 8, and again and again.
  const std::vector<LocalRate> rates = local_rates(exact(DecayForm::viscoelastic, {1.0, 4.0, 0.0, 100.0}, 0.02, 10000));
  ASSERT_EQ(rates.size(), window_levels.size());
  for (const LocalRate& each : rates) {
    EXPECT_LT(each.end, 8.0);
    EXPECT_GT(each.rate.value, 0.0);
  }
  for (std::size_t k = 1; k < rates.size(); ++k) EXPECT_GT(rates[k].rate.value, rates[k - 1].rate.value);
}

TEST(WaveDecay, AWindowWithoutAnEndEndsWithTheRecord) {
  const std::vector<LocalRate> rates = local_rates(exact(DecayForm::exponential, {1.0, 0.01, 0.0, 0.0}, 1.0, 75));
  ASSERT_EQ(rates.size(), 3u) << "0.8, 0.6, and down to 0.48";
  EXPECT_EQ(rates.back().end, 74.0);
  EXPECT_NEAR(rates.back().rate.value, 0.01, 1e-8);
}

TEST(WaveDecay, ShortWindowsAreJoinedWithTheNext) {
  const std::vector<LocalRate> rates = local_rates(exact(DecayForm::exponential, {1.0, 0.2, 0.0, 0.0}, 1.0, 30));
  ASSERT_FALSE(rates.empty());
  for (const LocalRate& each : rates) {
    EXPECT_GE(each.end - each.begin, 3.0);
    EXPECT_NEAR(each.rate.value, 0.2, 1e-8);
  }
  EXPECT_LT(rates.size(), window_levels.size());
}

TEST(WaveDecay, TheRateOfAConstantWaveIsNothingWithinItsError) {
  const NoisyWave noisy{DecayForm::exponential, {1.0, 0.0, 0.0, 0.0}, 1.0, 100, 8, 0.05, 3.0};
  const DecayingWave wave = noisy.realisation(21);
  const std::vector<LocalRate> rates = local_rates(wave);
  ASSERT_EQ(rates.size(), 1u);
  EXPECT_LT(std::abs(rates[0].rate.value), 4.0 * rates[0].rate.error);
  EXPECT_LT(std::abs(rates[0].amplitude.value - 1.0), 4.0 * rates[0].amplitude.error);
  EXPECT_TRUE(std::isnan(integral_rate({1.0, {std::vector<double>(50, 1.0)}}).rate.value));
}

TEST(WaveDecay, NothingIsToldFromNoise) {
  const NoisyWave loud{DecayForm::exponential, {1.0, 0.05, 0.0, 0.0}, 0.5, 400, 8, 0.2, 5.0};
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const LocalRate& each : local_rates(loud.realisation(seed))) {
      EXPECT_GE(each.amplitude.value, 3.0 * each.amplitude.error);
      EXPECT_LT(each.begin, -std::log(0.05) / 0.05) << "where a falls below its noise";
    }
  EXPECT_TRUE(local_rates({1.0, {std::vector<double>(20, 0.0)}}).empty());
  EXPECT_TRUE(local_rates({1.0, {std::vector<double>(20, -1.0)}}).empty());
  EXPECT_TRUE(std::isnan(integral_rate({1.0, {std::vector<double>(20, -1.0)}}).rate.value));
}

/// How often one error covers the truth must be within four standard deviations of the binomial distribution, a
/// hundredth allowed for the error's own error.
void expect_coverage(int covered, int cases) {
  EXPECT_NEAR(static_cast<double>(covered) / cases, 0.6827, 0.01 + 4.0 * std::sqrt(0.6827 * 0.3173 / cases));
}

TEST(WaveDecay, OneErrorOfALocalRateCoversTheTruthAsOftenAsItShould) {
  const NoisyWave noisy{DecayForm::exponential, {1.0, 0.05, 0.0, 0.0}, 0.5, 120, 8, 0.03, 5.0};
  int covered[4] = {}, cases = 300;
  for (int k = 0; k < cases; ++k) {
    const std::vector<LocalRate> rates = local_rates(noisy.realisation(static_cast<std::uint64_t>(k)));
    ASSERT_GE(rates.size(), 4u);
    for (std::size_t w = 0; w < 4; ++w) covered[w] += std::abs(rates[w].rate.value - 0.05) <= rates[w].rate.error;
  }
  for (const int each : covered) expect_coverage(each, cases);
}

TEST(WaveDecay, TheIntegralGivesTheRateHoweverShortTheRecord) {
  for (const double duration : {1.0, 3.0, 30.0}) {
    const double rate = 0.05, interval = 0.01 * duration / rate;
    const IntegralRate found = integral_rate(exact(DecayForm::exponential, {0.2, rate, 0.0, 0.0}, interval, 101));
    const double step = rate * interval, tail = std::exp(-duration);
    const double excess = (0.5 * step / std::tanh(0.5 * step) - 1.0) * (1.0 - tail);  // of the trapezoidal rule
    EXPECT_NEAR(found.rate.value, rate / (1.0 + excess), 1e-8 * rate);
    EXPECT_NEAR(found.tail_share.value, tail / (1.0 + excess), 1e-8);
    EXPECT_TRUE(std::isnan(found.rate.error));
  }
}

TEST(WaveDecay, TheIntegralOfAMaxwellFluidDoesNotKnowOfItsMemory) {
  for (const double tau : {1.0, 4.0, 12.0})
    EXPECT_NEAR(integral_rate(exact(DecayForm::viscoelastic, {1.0, 0.05, 0.0, tau}, 0.5, 601)).rate.value, 0.05, 2e-5);
}

TEST(WaveDecay, TheIntegralTakesAnImposedAmplitudeThatIsKnown) {
  const DecayingWave wave = exact(DecayForm::exponential, {0.9, 0.05, 0.0, 0.0}, 0.25, 801);
  EXPECT_NEAR(integral_rate(wave, 1.0).rate.value / integral_rate(wave).rate.value, 1.0 / 0.9, 1e-12);
}

TEST(WaveDecay, TheIntegralIsRefusedWhileTheWaveStillRings) {
  const DecayParameters bell{1.0, 4.0, 0.0, 100.0};
  EXPECT_TRUE(std::isnan(integral_rate(exact(DecayForm::viscoelastic, bell, 0.25, 400)).rate.value));
  EXPECT_NEAR(integral_rate(exact(DecayForm::viscoelastic, bell, 0.25, 8000)).rate.value, 4.0, 0.05);
  const NoisyWave noisy{DecayForm::viscoelastic, bell, 0.25, 400, 8, 0.05, 5.0};
  EXPECT_TRUE(std::isnan(integral_rate(noisy.realisation(3)).rate.value));
}

TEST(WaveDecay, OneErrorOfTheIntegralCoversTheTruthAsOftenAsItShould) {
  for (const double duration : {1.0, 6.0}) {
    NoisyWave noisy{DecayForm::exponential, {1.0, 0.05, 0.0, 0.0}, 0.5, 0, 8, 0.05, 5.0};
    noisy.samples = static_cast<std::size_t>(duration / 0.05 / 0.5) + 1;
    int covered = 0, share_covered = 0, cases = 300;
    for (int k = 0; k < cases; ++k) {
      const IntegralRate found = integral_rate(noisy.realisation(static_cast<std::uint64_t>(k)), 1.0);
      covered += std::abs(found.rate.value - 0.05) <= found.rate.error;
      share_covered += std::abs(found.tail_share.value - std::exp(-duration)) <= found.tail_share.error;
    }
    expect_coverage(covered, cases);
    expect_coverage(share_covered, cases);
  }
}

}  // namespace
}  // namespace lucy::statistics

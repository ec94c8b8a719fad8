// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/decay_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "statistics/noisy_wave.hpp"

namespace lucy::statistics {
namespace {

constexpr auto exponential = DecayForm::exponential;
constexpr auto yielding = DecayForm::yielding;
constexpr auto viscoelastic = DecayForm::viscoelastic;

// G = 0.05 in all of them, over five decay times.
const NoisyWave viscous_wave{exponential, {1.0, 0.05, 0.0, 0.0}, 1.0, 100, 8, 0.05, 5.0};
const NoisyWave yielding_wave{yielding, {1.0, 0.05, 0.05 * 0.2, 0.0}, 1.0, 100, 8, 0.02, 5.0};
const NoisyWave memory_wave{viscoelastic, {1.0, 0.05, 0.0, 4.0}, 1.0, 100, 8, 0.02, 5.0};
const NoisyWave ringing_wave{viscoelastic, {1.0, 0.5, 0.0, 25.0}, 1.0, 100, 8, 0.05, 5.0};

const FormFit& fit_of(const DecayComparison& comparison, DecayForm form) {
  return comparison.fits[static_cast<std::size_t>(form)];
}

int times_preferred(DecayForm form, const NoisyWave& wave, int cases) {
  int count = 0;
  for (int k = 0; k < cases; ++k)
    count += compare_decay_forms(wave.realisation(static_cast<std::uint64_t>(k))).preferred == form;
  return count;
}

void expect_within_four_errors(const Estimate& estimate, double truth) {
  EXPECT_GT(estimate.error, 0.0);
  EXPECT_LT(std::abs(estimate.value - truth), 4.0 * estimate.error) << estimate.value << " +- " << estimate.error;
}

TEST(DecayComparison, RecoversTheParametersOfTheTrueForm) {
  for (std::uint64_t seed = 100; seed < 104; ++seed) {
    const FormFit viscous = fit_form(viscous_wave.realisation(seed), exponential);
    expect_within_four_errors(viscous.amplitude, 1.0);
    expect_within_four_errors(viscous.rate, 0.05);
    EXPECT_EQ(viscous.rate.value, viscous.parameters.rate);
    EXPECT_TRUE(std::isnan(viscous.deceleration.value) && std::isnan(viscous.memory_time.value));

    const FormFit yields = fit_form(yielding_wave.realisation(seed), yielding);
    expect_within_four_errors(yields.amplitude, 1.0);
    expect_within_four_errors(yields.rate, 0.05);
    expect_within_four_errors(yields.deceleration, 0.01);
    expect_within_four_errors(yields.yield_amplitude, 0.2);
    EXPECT_TRUE(std::isnan(yields.memory_time.value));

    for (const NoisyWave& wave : {memory_wave, ringing_wave}) {
      const FormFit remembers = fit_form(wave.realisation(seed), viscoelastic);
      expect_within_four_errors(remembers.amplitude, 1.0);
      expect_within_four_errors(remembers.rate, wave.truth.rate);
      expect_within_four_errors(remembers.memory_time, wave.truth.memory_time);
      expect_within_four_errors(remembers.natural_frequency, wave.truth.natural_frequency());
      EXPECT_TRUE(std::isnan(remembers.yield_amplitude.value));
    }
  }
}

TEST(DecayComparisonLong, OneErrorOfTheRateCoversTheTruthAsOftenAsItShould) {
  const int cases = 300;
  for (const NoisyWave& wave : {viscous_wave, yielding_wave, memory_wave}) {
    int covered = 0;
    for (int k = 0; k < cases; ++k) {
      const FormFit fit = fit_form(wave.realisation(static_cast<std::uint64_t>(k)), wave.form);
      covered += std::abs(fit.rate.value - 0.05) <= fit.rate.error;
    }
    EXPECT_NEAR(static_cast<double>(covered) / cases, 0.6827, 0.01 + 4.0 * std::sqrt(0.6827 * 0.3173 / cases))
        << name(wave.form);
  }
}

TEST(DecayComparison, PrefersTheTrueFormWhereTheDifferenceIsReal) {
  EXPECT_GE(times_preferred(yielding, yielding_wave, 20), 18);
  EXPECT_GE(times_preferred(viscoelastic, memory_wave, 20), 18);
  EXPECT_EQ(times_preferred(viscoelastic, ringing_wave, 20), 20);
}

TEST(DecayComparisonLong, DoesNotPreferARicherFormOfAnExponentialWave) {
  EXPECT_GE(times_preferred(exponential, viscous_wave, 100), 90);
  NoisyWave few = viscous_wave;
  few.replicas = 4;
  EXPECT_GE(times_preferred(exponential, few, 100), 90);
  NoisyWave slow = viscous_wave;  // the noise forgets as slowly as the wave decays, as thermal noise does
  slow.relaxation_time = 20.0;
  EXPECT_GE(times_preferred(exponential, slow, 100), 90);
}

TEST(DecayComparison, SaysHowFarTheFormsAreApart) {
  const DecayComparison comparison = compare_decay_forms(yielding_wave.realisation(5));
  EXPECT_TRUE(comparison.by_likelihood);
  const auto& [yield, memory, richer] = comparison.differences;
  EXPECT_EQ(yield.first, exponential);
  EXPECT_EQ(yield.second, yielding);
  EXPECT_EQ(memory.second, viscoelastic);
  EXPECT_EQ(richer.first, yielding);
  EXPECT_EQ(richer.second, viscoelastic);
  EXPECT_LT(yield.log_likelihood.value, -2.0 * yield.log_likelihood.error);
  EXPECT_NEAR(richer.log_likelihood.value, memory.log_likelihood.value - yield.log_likelihood.value, 1e-9);
  EXPECT_LT(fit_of(comparison, yielding).residual_over_error, 1.5);
  EXPECT_GT(fit_of(comparison, exponential).residual_over_error, 2.0);
  EXPECT_LT(fit_of(comparison, yielding).relative_residual, fit_of(comparison, exponential).relative_residual);
}

TEST(DecayComparison, KnowsTheNoiseAndHowLongItLasts) {
  NoisyWave wave = viscous_wave;
  wave.replicas = 40;
  wave.samples = 400;
  const DecayComparison comparison = compare_decay_forms(wave.realisation(9));
  const double phi = std::exp(-1.0 / 5.0), inefficiency = (1.0 + phi) / (1.0 - phi);
  // 16000 samples are 1600 independent ones, of squares about 3200: 1.3 % of sigma and, four times that, 5 %.
  EXPECT_NEAR(comparison.noise, 0.05, 0.05 * 0.05);
  EXPECT_NEAR(comparison.inefficiency, inefficiency, 0.3 * inefficiency);
}

TEST(DecayComparison, ALogLikelihoodCountsIndependentValues) {
  // Sampled ten times as often, noise that lasts for many samples tells nothing more.
  NoisyWave coarse = yielding_wave;
  coarse.replicas = 16;
  NoisyWave fine = coarse;
  fine.interval = 0.1;
  fine.samples = 1000;
  double of_coarse = 0.0, of_fine = 0.0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    of_coarse += compare_decay_forms(coarse.realisation(seed)).differences[0].log_likelihood.value;
    of_fine += compare_decay_forms(fine.realisation(seed)).differences[0].log_likelihood.value;
  }
  EXPECT_GT(of_fine / of_coarse, 0.5);
  EXPECT_LT(of_fine / of_coarse, 2.0);
}

TEST(DecayComparison, ComparesByResidualsWhereThereAreTooFewReplicas) {
  for (const std::size_t replicas : {1, 2, 3}) {
    for (NoisyWave wave : {viscous_wave, yielding_wave, ringing_wave}) {
      wave.replicas = replicas;
      wave.noise = 0.005;
      const DecayComparison comparison = compare_decay_forms(wave.realisation(2));
      EXPECT_FALSE(comparison.by_likelihood);
      EXPECT_EQ(comparison.preferred, wave.form) << replicas;
      EXPECT_TRUE(std::isnan(comparison.inefficiency));
      for (const FormDifference& each : comparison.differences) {
        EXPECT_TRUE(std::isnan(each.log_likelihood.value));
        EXPECT_TRUE(std::isnan(each.log_likelihood.error));
      }
      EXPECT_EQ(std::isnan(comparison.noise), replicas == 1);
      for (const FormFit& fit : comparison.fits) {
        EXPECT_EQ(std::isnan(fit.rate.error), replicas == 1);
        EXPECT_EQ(std::isnan(fit.residual_over_error), replicas == 1);
        EXPECT_GT(fit.relative_residual, 0.0);
      }
    }
  }
}

TEST(DecayComparison, ComparesByResidualsWhereReplicasAgreeToRounding) {
  for (NoisyWave wave : {viscous_wave, yielding_wave, memory_wave, ringing_wave}) {
    for (const double noise : {0.0, 1e-14}) {
      wave.noise = noise;
      const DecayComparison comparison = compare_decay_forms(wave.realisation(4));
      EXPECT_FALSE(comparison.by_likelihood);
      EXPECT_EQ(comparison.preferred, wave.form);
      const FormFit& fit = fit_of(comparison, wave.form);
      EXPECT_NEAR(fit.rate.value, wave.truth.rate, 1e-6 * wave.truth.rate);
      EXPECT_LT(fit.rate.error, 1e-6);
      EXPECT_LT(fit.relative_residual, 1e-8);
    }
  }
}

TEST(DecayComparison, FindsNoDecayInAConstantWave) {
  NoisyWave wave = viscous_wave;
  wave.truth.rate = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const DecayComparison comparison = compare_decay_forms(wave.realisation(seed));
    EXPECT_EQ(comparison.preferred, exponential);
    EXPECT_LT(std::abs(fit_of(comparison, exponential).rate.value), 4.0 * fit_of(comparison, exponential).rate.error);
  }
  const DecayComparison nothing = compare_decay_forms({1.0, {5, std::vector<double>(20, 0.0)}});
  EXPECT_EQ(nothing.preferred, exponential);
  EXPECT_EQ(fit_of(nothing, exponential).relative_residual, 0.0);
}

}  // namespace
}  // namespace lucy::statistics

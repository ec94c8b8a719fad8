// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/decay_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "lucy/statistics/running_integral.hpp"

namespace lucy::statistics {
namespace {

constexpr auto exponential = DecayForm::exponential;
constexpr auto yielding = DecayForm::yielding;
constexpr auto viscoelastic = DecayForm::viscoelastic;

std::vector<double> equal_times(double interval, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(interval * i);
  return times;
}

std::vector<double> curve(DecayForm form, const DecayParameters& parameters, const std::vector<double>& times) {
  std::vector<double> values;
  for (const double time : times) values.push_back(decay_form(form, parameters, time));
  return values;
}

double squares_about(DecayForm form, const DecayParameters& parameters, const std::vector<double>& times,
                     const std::vector<double>& values) {
  const std::vector<double> fitted = curve(form, parameters, times);
  double sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) sum += (fitted[i] - values[i]) * (fitted[i] - values[i]);
  return sum;
}

double slope(DecayForm form, const DecayParameters& p, double time) {
  constexpr double step = 1e-4;
  return (decay_form(form, p, time + step) - decay_form(form, p, time - step)) / (2.0 * step);
}

TEST(DecayForms, YieldingObeysItsEquationUntilItStopsForGood) {
  for (const double s : {0.01, 0.3, 5.0}) {
    const double a0 = 0.7, rate = 0.2;
    const DecayParameters p{a0, rate, rate * s, 0.0};
    EXPECT_NEAR(p.yield_amplitude(), s, 1e-15);
    EXPECT_EQ(decay_form(yielding, p, 0.0), a0);
    const double stop = std::log(1.0 + a0 / s) / rate;
    for (const double part : {0.1, 0.5, 0.9}) {
      const double a = decay_form(yielding, p, part * stop);
      EXPECT_NEAR(slope(yielding, p, part * stop), -rate * (a + s), 1e-7);
      EXPECT_GT(a, 0.0);
    }
    EXPECT_NEAR(decay_form(yielding, p, stop), 0.0, 1e-14);
    EXPECT_EQ(decay_form(yielding, p, 1.01 * stop), 0.0);
    EXPECT_EQ(decay_form(yielding, p, 100.0 * stop), 0.0);
  }
}

TEST(DecayForms, YieldingIsAStraightLineWithoutViscosity) {
  const DecayParameters plastic{2.0, 0.0, 0.1, 0.0};
  EXPECT_NEAR(decay_form(yielding, plastic, 5.0), 1.5, 1e-15);
  EXPECT_EQ(decay_form(yielding, plastic, 30.0), 0.0);
  EXPECT_NEAR(decay_form(yielding, {-2.0, 0.0, 0.1, 0.0}, 5.0), -1.5, 1e-15);
  EXPECT_TRUE(std::isinf(plastic.yield_amplitude()));
  EXPECT_NEAR(decay_form(yielding, {2.0, 1e-9, 0.1, 0.0}, 5.0), 1.5, 1e-7);
}

TEST(DecayForms, ViscoelasticObeysItsEquationOverAndUnderCriticalDamping) {
  const double rate = 0.3;
  for (const double product : {0.01, 0.1, 0.2499999, 0.25, 0.2500001, 0.4, 3.0, 100.0}) {
    const DecayParameters p{1.4, rate, 0.0, product / rate};
    EXPECT_EQ(decay_form(viscoelastic, p, 0.0), 1.4);
    EXPECT_NEAR(slope(viscoelastic, p, 0.0), 0.0, 1e-2) << "no stress has built up yet";
    for (const double time : {0.3, 2.0, 11.0}) {
      constexpr double step = 1e-3;
      const double before = decay_form(viscoelastic, p, time - step), now = decay_form(viscoelastic, p, time),
                   after = decay_form(viscoelastic, p, time + step);
      const double first = (after - before) / (2.0 * step), second = (after - 2.0 * now + before) / (step * step);
      EXPECT_NEAR(p.memory_time * second + first + rate * now, 0.0, 1e-5 * (1.0 + p.memory_time)) << product;
    }
  }
}

TEST(DecayForms, ViscoelasticIsContinuousThroughCriticalDampingAndBecomesTheExponential) {
  const double tau = 2.0;
  for (const double time : {0.1, 1.0, 10.0, 60.0}) {
    const double x = time / (2.0 * tau), critical = std::exp(-x) * (1.0 + x);
    for (const double off : {-1e-6, -1e-9, 0.0, 1e-9, 1e-6})
      EXPECT_NEAR(decay_form(viscoelastic, {1.0, 0.25 / tau * (1.0 + off), 0.0, tau}, time) / critical, 1.0, 1e-3)
          << time << " " << off;
    const double without_memory = std::exp(-0.1 * time);
    EXPECT_NEAR(decay_form(viscoelastic, {1.0, 0.1, 0.0, 1e-9}, time), without_memory, 1e-8);
    EXPECT_EQ(decay_form(viscoelastic, {1.0, 0.1, 0.0, 0.0}, time), without_memory);
  }
}

TEST(DecayForms, ViscoelasticRingsAtItsNaturalFrequencyWhenHardlyDamped) {
  const DecayParameters p{1.0, 40.0, 0.0, 1000.0};
  EXPECT_NEAR(p.natural_frequency(), 0.2, 1e-15);
  const double period = 2.0 * std::numbers::pi / 0.2;
  EXPECT_NEAR(decay_form(viscoelastic, p, 0.25 * period), 0.0, 0.01);
  EXPECT_NEAR(decay_form(viscoelastic, p, 0.5 * period), -std::exp(-0.25 * period / 1000.0), 1e-4);
  EXPECT_TRUE(std::isinf(DecayParameters{}.natural_frequency()));
}

TEST(DecayForms, HaveTheIntegralsThatFollowFromTheirEquations) {
  const std::vector<double> times = equal_times(0.01, 60000);
  const auto integral = [&](DecayForm form, const DecayParameters& p) {
    return running_integral(times, curve(form, p, times)).back();
  };
  EXPECT_NEAR(integral(exponential, {0.6, 0.05, 0.0, 0.0}), 0.6 / 0.05, 1e-4);
  for (const double tau : {0.5, 5.0, 20.0})
    EXPECT_NEAR(integral(viscoelastic, {0.6, 0.05, 0.0, tau}), 0.6 / 0.05, 1e-4) << tau;
  for (const double s : {0.01, 0.3})
    EXPECT_NEAR(integral(yielding, {0.6, 0.05, 0.05 * s, 0.0}), (0.6 - s * std::log(1.0 + 0.6 / s)) / 0.05, 1e-4) << s;
}

TEST(DecayForms, AreFoundExactlyWhateverTheirScales) {
  for (const double unit : {1e-3, 1.0, 1e4}) {
    const std::vector<double> times = equal_times(0.5 * unit, 150);
    const double a0 = 0.02 / unit;
    for (const double rate : {0.01 / unit, 0.05 / unit, 0.3 / unit}) {
      const DecayParameters plain = fit_decay_form(exponential, times, curve(exponential, {a0, rate, 0.0, 0.0}, times));
      EXPECT_NEAR(plain.amplitude, a0, 1e-6 * a0);
      EXPECT_NEAR(plain.rate, rate, 1e-6 * rate);
      for (const double s : {0.02, 0.3, 2.0}) {
        const DecayParameters truth{a0, rate, rate * s * a0, 0.0};
        const DecayParameters found = fit_decay_form(yielding, times, curve(yielding, truth, times));
        EXPECT_NEAR(found.amplitude, a0, 1e-5 * a0);
        EXPECT_NEAR(found.rate, rate, 1e-4 * rate) << s;
        EXPECT_NEAR(found.yield_amplitude(), s * a0, 1e-4 * s * a0);
      }
      for (const double product : {0.1, 0.25, 1.0, 30.0}) {
        const DecayParameters truth{a0, rate, 0.0, product / rate};
        const DecayParameters found = fit_decay_form(viscoelastic, times, curve(viscoelastic, truth, times));
        EXPECT_NEAR(found.amplitude, a0, 1e-5 * a0);
        EXPECT_NEAR(found.rate, rate, 1e-4 * rate) << product;
        EXPECT_NEAR(found.memory_time, product / rate, 1e-4 * product / rate);
      }
    }
  }
}

TEST(DecayForms, FollowsAWaveThatRingsManyTimes) {
  const std::vector<double> times = equal_times(0.25, 800);
  const DecayParameters truth{1.0, 20.0, 0.0, 40.0};
  std::vector<double> values = curve(viscoelastic, truth, times);
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  for (double& value : values) value += 0.05 * normal(generator);
  const DecayParameters found = fit_decay_form(viscoelastic, times, values);
  EXPECT_NEAR(found.natural_frequency(), truth.natural_frequency(), 1e-3);
  EXPECT_NEAR(found.memory_time, 40.0, 4.0);
}

TEST(DecayForms, LieOnTheirBoundsWhereTheDataDo) {
  const std::vector<double> times = equal_times(1.0, 100);
  // Slower than exponential at the end: neither a yield stress nor a memory does that.
  const auto values_of = [&](const std::function<double(double)>& shape) {
    std::vector<double> values;
    for (const double time : times) values.push_back(shape(time));
    return values;
  };
  const std::vector<double> slow =
      values_of([](double t) { return 0.5 * std::exp(-0.2 * t) + 0.5 * std::exp(-0.02 * t); });
  const DecayParameters plain = fit_decay_form(exponential, times, slow);
  const DecayParameters yield = fit_decay_form(yielding, times, slow);
  const DecayParameters memory = fit_decay_form(viscoelastic, times, slow);
  EXPECT_EQ(yield.deceleration, 0.0);
  EXPECT_EQ(yield.rate, plain.rate);
  EXPECT_EQ(memory.memory_time, 0.0);
  EXPECT_EQ(memory.rate, plain.rate);
  // A straight line bent outwards: a negative viscosity would fit it better.
  const std::vector<double> bent = values_of([](double t) { return 1.0 - 0.005 * t - 2e-5 * t * t; });
  const DecayParameters plastic = fit_decay_form(yielding, times, bent);
  EXPECT_EQ(plastic.rate, 0.0);
  EXPECT_NEAR(plastic.deceleration, 0.007, 5e-4);
}

TEST(DecayForms, FindNoDecayInAConstantAndNothingInZeros) {
  const std::vector<double> times = equal_times(1.0, 50);
  for (const DecayForm form : decay_forms) {
    const DecayParameters constant = fit_decay_form(form, times, std::vector<double>(50, 0.3));
    EXPECT_NEAR(constant.amplitude, 0.3, 1e-7) << name(form);
    EXPECT_NEAR(decay_form(form, constant, 49.0), 0.3, 1e-6) << name(form);
    EXPECT_EQ(fit_decay_form(form, times, std::vector<double>(50, 0.0)).amplitude, 0.0);
  }
  EXPECT_LT(fit_decay_form(exponential, times, curve(exponential, {1.0, -0.01, 0.0, 0.0}, times)).rate, -0.0099);
}

TEST(DecayForms, ARicherFormNeverFitsWorseNorDoesARefit) {
  const std::vector<double> times = equal_times(0.5, 120);
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 90; ++i) {
    const DecayForm truth = decay_forms[static_cast<std::size_t>(i) % 3];
    std::vector<double> values = curve(truth, {1.0, 0.1, truth == yielding ? 0.02 : 0.0, 15.0}, times);
    for (double& value : values) value += 0.03 * (i % 30) * normal(generator) * (i % 30 == 7 ? 1e100 : 1.0);
    const double simplest = squares_about(exponential, fit_decay_form(exponential, times, values), times, values);
    for (const DecayForm form : {yielding, viscoelastic}) {
      const DecayParameters found = fit_decay_form(form, times, values);
      const double squares = squares_about(form, found, times, values);
      EXPECT_LE(squares, simplest * (1.0 + 1e-12));
      EXPECT_GE(found.deceleration, 0.0);
      EXPECT_GE(found.memory_time, 0.0);
      const DecayParameters again = refit_decay_form(form, times, values, found);
      EXPECT_LE(squares_about(form, again, times, values), squares * (1.0 + 1e-6) + 1e-12) << i << " " << name(form);
    }
  }
}

}  // namespace
}  // namespace lucy::statistics

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/correlator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

namespace lucy::measure {
namespace {

template <class T>
concept Correlator = std::movable<T> && requires(T t, const T& constant, ArchiveWriter& writer, ArchiveReader& reader) {
  t.add(1.0);
  t.add(1.0, 2.0);
  { constant.result(Means::subtracted) } -> std::same_as<Correlation>;
  { constant.samples() } -> std::same_as<std::int64_t>;
  constant.save(writer);
  t.load(reader);
  t.merge(constant);
};
static_assert(Correlator<FftCorrelator> && Correlator<MultipleTauCorrelator>);

using Series = std::vector<double>;

struct Sampled {
  Series a;
  Series b;
};

// Two correlated red series.
Sampled sampled(std::size_t length, std::uint64_t seed, double mean_a = 0.0, double mean_b = 0.0) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Sampled series;
  double slow = normal(generator);
  for (std::size_t i = 0; i < length; ++i) {
    slow = 0.9 * slow + std::sqrt(1.0 - 0.81) * normal(generator);
    // Whole multiples of 2^-20: adding a mean of a million leaves the fluctuations exactly as they were.
    const auto rounded = [](double x) { return std::ldexp(std::round(std::ldexp(x, 20)), -20); };
    series.a.push_back(mean_a + rounded(slow));
    series.b.push_back(mean_b + rounded(slow + 0.5 * normal(generator)));
  }
  return series;
}

Series averaged(const Series& series, std::size_t over) {
  Series result;
  for (std::size_t i = 0; i + over <= series.size(); i += over) {
    double sum = 0.0;
    for (std::size_t j = 0; j < over; ++j) sum += series[i + j];
    result.push_back(sum / static_cast<double>(over));
  }
  return result;
}

// What lag `lag` of series averaged over `over` samples gives, by loops over all pairs of all series.
struct Loop {
  long double product = 0.0L;
  long double a = 0.0L;
  long double b = 0.0L;
  std::int64_t pairs = 0;

  Loop(const std::vector<Sampled>& all, std::size_t lag, std::size_t over) {
    for (const Sampled& series : all) {
      const Series of_a = averaged(series.a, over), of_b = averaged(series.b, over);
      for (std::size_t i = 0; i + lag < of_a.size(); ++i) {
        product += static_cast<long double>(of_a[i]) * of_b[i + lag];
        a += of_a[i];
        b += of_b[i + lag];
        ++pairs;
      }
    }
  }

  double value(Means means) const {
    const auto n = static_cast<long double>(pairs);
    return static_cast<double>(means == Means::subtracted ? product / n - a / n * (b / n) : product / n);
  }
};

constexpr std::size_t fft_lags = 40;
constexpr MultipleTauCorrelator::Settings multiple_tau{.longest_lag = 40.0, .lags_per_level = 6, .averaged = 3};

// What the typed tests need to know of each: a fresh one, one of other settings, and the samples that become one value
// at a lag.
template <class T>
struct Kind;
template <>
struct Kind<FftCorrelator> {
  static FftCorrelator fresh() { return FftCorrelator(fft_lags, 20); }  // segments of 25
  static FftCorrelator other() { return FftCorrelator(fft_lags + 1, 20); }
  static std::size_t over(double) { return 1; }
};
template <>
struct Kind<MultipleTauCorrelator> {
  static MultipleTauCorrelator fresh() { return MultipleTauCorrelator(multiple_tau); }
  static MultipleTauCorrelator other() {
    MultipleTauCorrelator::Settings settings = multiple_tau;
    settings.components = 2;
    return MultipleTauCorrelator(settings);
  }
  static std::size_t over(double lag) { return lag < 6.0 ? 1 : lag < 18.0 ? 3 : 9; }
};

template <class T>
void take_in(T& correlator, const Sampled& series, std::size_t begin = 0,
             std::size_t end = std::numeric_limits<std::size_t>::max()) {
  for (std::size_t i = begin; i < std::min(end, series.a.size()); ++i) correlator.add(series.a[i], series.b[i]);
}

template <class T>
void expect_loops(const T& correlator, const std::vector<Sampled>& all, double tolerance = 1e-13) {
  for (const Means means : {Means::known_zero, Means::subtracted}) {
    const Correlation result = correlator.result(means);
    ASSERT_EQ(result.value.size(), result.lag.size());
    ASSERT_EQ(result.pairs.size(), result.lag.size());
    for (std::size_t k = 0; k < result.lag.size(); ++k) {
      const std::size_t over = Kind<T>::over(result.lag[k]);
      const Loop loop(all, static_cast<std::size_t>(result.lag[k]) / over, over);
      ASSERT_EQ(result.pairs[k], loop.pairs) << "lag " << result.lag[k];
      ASSERT_NEAR(result.value[k], loop.value(means), tolerance) << "lag " << result.lag[k];
    }
  }
}

void expect_same_bits(const Correlation& one, const Correlation& two) {
  EXPECT_EQ(one.lag, two.lag);
  EXPECT_EQ(one.value, two.value);
  EXPECT_EQ(one.pairs, two.pairs);
}

template <class T>
class EveryCorrelator : public testing::Test {};
using Correlators = testing::Types<FftCorrelator, MultipleTauCorrelator>;
TYPED_TEST_SUITE(EveryCorrelator, Correlators);

TYPED_TEST(EveryCorrelator, EqualsLoopsOverTheWholeSeriesAtEveryMoment) {
  const Sampled series = sampled(700, 1);
  auto correlator = Kind<TypeParam>::fresh();
  EXPECT_TRUE(correlator.result().lag.empty());
  std::size_t taken = 0;
  for (const std::size_t length : {1, 2, 3, 39, 40, 41, 63, 64, 65, 89, 90, 128, 200, 699, 700}) {
    take_in(correlator, series, taken, length);
    taken = length;
    EXPECT_EQ(correlator.samples(), static_cast<std::int64_t>(length));
    const auto until = static_cast<std::ptrdiff_t>(length);
    expect_loops(correlator, {{Series(series.a.begin(), series.a.begin() + until),
                               Series(series.b.begin(), series.b.begin() + until)}});
  }
  EXPECT_GE(correlator.result().lag.back(), 39.0);
}

TYPED_TEST(EveryCorrelator, GivesTheAutocorrelationOfOneSeries) {
  const Sampled series = sampled(300, 2);
  auto correlator = Kind<TypeParam>::fresh();
  for (const double a : series.a) correlator.add(a);
  expect_loops(correlator, {{series.a, series.a}});
}

TYPED_TEST(EveryCorrelator, KeepsItsDigitsUnderAMeanAMillionTimesTheFluctuations) {
  auto centred = Kind<TypeParam>::fresh();
  auto far = Kind<TypeParam>::fresh();
  take_in(centred, sampled(2000, 3));
  const Sampled series = sampled(2000, 3, 1e6, -3e6);
  take_in(far, series);
  auto merged = Kind<TypeParam>::fresh();
  merged.merge(far);
  const Correlation expected = centred.result(Means::subtracted);
  for (const auto* correlator : {&far, &merged}) {
    const Correlation result = correlator->result(Means::subtracted);
    ASSERT_EQ(result.value.size(), expected.value.size());
    for (std::size_t k = 0; k < result.value.size(); ++k) EXPECT_NEAR(result.value[k], expected.value[k], 1e-13);
  }
  const Correlation whole = far.result(Means::known_zero);
  EXPECT_NEAR(whole.value[3] / Loop({series}, 3, 1).value(Means::known_zero), 1.0, 1e-15);
}

TYPED_TEST(EveryCorrelator, GoesOnFromASavedStateWithTheSameBits) {
  const Sampled series = sampled(400, 4, 1.0, 2.0), before = sampled(150, 5);
  for (const bool merged : {false, true}) {
    auto whole = Kind<TypeParam>::fresh();
    if (merged) {
      auto other = Kind<TypeParam>::fresh();
      take_in(other, before);
      whole.merge(other);
    }
    for (std::size_t saved_at = 0; saved_at < 200; ++saved_at) {
      ArchiveWriter saved;
      whole.save(saved);
      auto resumed = Kind<TypeParam>::fresh();
      resumed.add(99.0, 98.0);
      ArchiveReader reader(saved.bytes());
      resumed.load(reader);
      ASSERT_TRUE(reader.exhausted());
      expect_same_bits(resumed.result(Means::subtracted), whole.result(Means::subtracted));
      if (saved_at % 10 == 0) {
        auto straight = Kind<TypeParam>::fresh();
        ArchiveReader again(saved.bytes());
        straight.load(again);
        take_in(straight, series, saved_at);
        take_in(resumed, series, saved_at, 300);
        ArchiveWriter later;
        resumed.save(later);
        ArchiveReader from_later(later.bytes());
        resumed.load(from_later);
        take_in(resumed, series, 300);
        expect_same_bits(resumed.result(), straight.result());
        expect_loops(resumed, merged ? std::vector{before, series} : std::vector{series});
      }
      whole.add(series.a[saved_at], series.b[saved_at]);
    }
  }
}

TYPED_TEST(EveryCorrelator, RefusesASavedStateOfOtherSettingsOrATruncatedOneAndStaysAsItWas) {
  auto correlator = Kind<TypeParam>::fresh();
  take_in(correlator, sampled(100, 6));
  const Correlation before = correlator.result();
  ArchiveWriter of_other;
  Kind<TypeParam>::other().save(of_other);
  ArchiveReader reader(of_other.bytes());
  EXPECT_THROW(correlator.load(reader), RunFailed);
  ArchiveWriter saved;
  correlator.save(saved);
  for (std::size_t length = 0; length < saved.bytes().size(); length += 7) {
    ArchiveReader truncated(std::span(saved.bytes()).first(length));
    EXPECT_THROW(correlator.load(truncated), RunFailed) << length << " bytes";
  }
  expect_same_bits(correlator.result(), before);
}

TYPED_TEST(EveryCorrelator, PoolsThePairsOfIndependentSeries) {
  // Of several lengths and means; the first goes on after the merging.
  const std::vector<Sampled> series = {sampled(333, 7, 5.0, 5.0), sampled(20, 8), sampled(91, 9, -3.0, 1.0)};
  auto pooled = Kind<TypeParam>::fresh();
  take_in(pooled, series[0], 0, 200);
  for (std::size_t s = 1; s < series.size(); ++s) {
    auto other = Kind<TypeParam>::fresh();
    take_in(other, series[s]);
    pooled.merge(other);
  }
  take_in(pooled, series[0], 200);
  EXPECT_EQ(pooled.samples(), 333 + 20 + 91);
  expect_loops(pooled, series, 1e-12);

  auto twice = Kind<TypeParam>::fresh();
  twice.merge(pooled);
  expect_loops(twice, series, 1e-12);
  twice.merge(twice);
  EXPECT_EQ(twice.result().pairs[1], 2 * pooled.result().pairs[1]);
  EXPECT_NEAR(twice.result().value[1], pooled.result().value[1], 1e-12);
}

TYPED_TEST(EveryCorrelator, IsNotChangedByMergingWithNothingAndRefusesOtherSettings) {
  auto correlator = Kind<TypeParam>::fresh();
  take_in(correlator, sampled(100, 10));
  const Correlation before = correlator.result(Means::subtracted);
  correlator.merge(Kind<TypeParam>::fresh());
  expect_same_bits(correlator.result(Means::subtracted), before);
  EXPECT_THROW(correlator.merge(Kind<TypeParam>::other()), std::invalid_argument);
}

TYPED_TEST(EveryCorrelator, GivesTheDecayOfAKnownProcess) {
  // x_{i+1} = phi x_i + noise, of variance one: C(k) = phi^k; its error is 0.004 after 10^6 samples.
  constexpr double phi = 0.9;
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  auto correlator = Kind<TypeParam>::fresh();
  double x = normal(generator);
  for (int i = 0; i < 1000000; ++i) {
    correlator.add(x);
    x = phi * x + std::sqrt(1.0 - phi * phi) * normal(generator);
  }
  const Correlation result = correlator.result();
  for (std::size_t k = 0; k < result.lag.size(); ++k) {
    // Averages over m samples: sum over the m^2 pairs of samples.
    const auto over = static_cast<int>(Kind<TypeParam>::over(result.lag[k]));
    double exact = 0.0;
    for (int i = 0; i < over; ++i) {
      for (int j = 0; j < over; ++j) exact += std::pow(phi, std::abs(result.lag[k] + j - i)) / (over * over);
    }
    EXPECT_NEAR(result.value[k], exact, 0.02) << "lag " << result.lag[k];
  }
}

TEST(FftCorrelator, GivesTheSameForEverySegment) {
  const Sampled series = sampled(3000, 12);
  FftCorrelator chosen(100);
  take_in(chosen, series);
  const Correlation expected = chosen.result();
  ASSERT_EQ(expected.value.size(), 100U);
  for (const std::size_t segment : {1, 7, 30, 100, 400, 3000, 10000}) {
    FftCorrelator correlator(100, segment);
    take_in(correlator, series);
    const Correlation result = correlator.result();
    ASSERT_EQ(result.pairs, expected.pairs);
    for (std::size_t k = 0; k < 100; ++k) EXPECT_NEAR(result.value[k], expected.value[k], 1e-14) << segment;
  }
}

TEST(FftCorrelator, DoesOneLagAndRefusesNone) {
  FftCorrelator variance(1, 5);
  const Sampled series = sampled(1000, 13, 4.0, 4.0);
  take_in(variance, series);
  const Correlation result = variance.result(Means::subtracted);
  ASSERT_EQ(result.lag, std::vector{0.0});
  EXPECT_NEAR(result.value[0], Loop({series}, 0, 1).value(Means::subtracted), 1e-14);
  EXPECT_THROW(FftCorrelator(0), std::invalid_argument);
}

TEST(MultipleTauCorrelator, HasEachLagOnceUpToTheLongest) {
  MultipleTauCorrelator correlator({.longest_lag = 30.0, .lags_per_level = 8, .averaged = 2});
  for (int i = 0; i < 1000; ++i) correlator.add(1.0);
  const Correlation result = correlator.result();
  EXPECT_EQ(result.lag, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56}));
  EXPECT_EQ(result.value, std::vector<double>(result.lag.size(), 1.0));
  EXPECT_EQ(result.pairs[8], 500 - 4);
  EXPECT_EQ(result.pairs.back(), 125 - 7);
}

TEST(MultipleTauCorrelator, AddsUpTheComponentsOfAVector) {
  for (const std::size_t components : {2, 8, 13}) {
    MultipleTauCorrelator::Settings settings = multiple_tau;
    std::vector<Sampled> series;
    std::vector<MultipleTauCorrelator> apart;
    for (std::size_t c = 0; c < components; ++c) {
      series.push_back(sampled(500, 20 + c, 100.0 * static_cast<double>(c), 1.0));
      apart.emplace_back(settings);
      take_in(apart.back(), series.back());
    }
    settings.components = components;
    MultipleTauCorrelator together(settings), halves(settings), second_half(settings);
    std::vector<double> a(components), b(components);
    for (std::size_t i = 0; i < 500; ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        a[c] = series[c].a[i];
        b[c] = series[c].b[i];
      }
      together.add(a, b);
      (i < 250 ? halves : second_half).add(a, b);
    }
    for (const Means means : {Means::known_zero, Means::subtracted}) {
      const Correlation result = together.result(means);
      for (std::size_t k = 0; k < result.lag.size(); ++k) {
        double sum = 0.0;
        for (const MultipleTauCorrelator& correlator : apart) sum += correlator.result(means).value[k];
        EXPECT_NEAR(result.value[k], sum, 1e-14 * std::abs(sum) + 1e-13 * static_cast<double>(components));
      }
    }
    halves.merge(second_half);
    for (std::size_t k = 0; k < 6; ++k) {
      double sum = 0.0;
      for (const Sampled& s : series) {
        const auto middle = std::ptrdiff_t{250};
        const Sampled front{Series(s.a.begin(), s.a.begin() + middle), Series(s.b.begin(), s.b.begin() + middle)};
        const Sampled back{Series(s.a.begin() + middle, s.a.end()), Series(s.b.begin() + middle, s.b.end())};
        sum += Loop({front, back}, k, 1).value(Means::subtracted);
      }
      EXPECT_NEAR(halves.result(Means::subtracted).value[k], sum, 1e-12 * static_cast<double>(components));
    }
  }
}

TEST(MultipleTauCorrelator, RefusesSettingsThatMakeNoLevelAndValuesOfOtherLengths) {
  using Settings = MultipleTauCorrelator::Settings;
  for (const Settings& settings :
       {Settings{.components = 0}, Settings{.longest_lag = std::nan("")}, Settings{.longest_lag = -1.0},
        Settings{.lags_per_level = 0}, Settings{.lags_per_level = 15}, Settings{.averaged = 1}}) {
    EXPECT_THROW(MultipleTauCorrelator{settings}, std::invalid_argument);
  }
  MultipleTauCorrelator correlator(Settings{.components = 3});
  const std::vector<double> two(2), three(3);
  EXPECT_THROW(correlator.add(two, three), std::invalid_argument);
  EXPECT_THROW(correlator.add(three, two), std::invalid_argument);
  EXPECT_THROW(correlator.add(1.0), std::invalid_argument);
  EXPECT_EQ(correlator.samples(), 0);
}

}  // namespace
}  // namespace lucy::measure

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Level l holds the last p values (p = lags_per_level), each the mean of m^l consecutive samples (m = averaged). Lag k
// of level l is k m^l samples long; the lags of level l - 1 end before p m^(l-1), so beyond the first level k begins at
// p/m.
#include <algorithm>
#include <array>
#include <stdexcept>

#include "lucy/measure/correlator.hpp"
#include "lucy/pairs/lanes.hpp"
#include "lucy/space/columns.hpp"
#include "measure/pair_sums.hpp"

namespace lucy::measure {

namespace {

using Values = space::AlignedVector<double>;

void check(const MultipleTauCorrelator::Settings& settings) {
  if (settings.components == 0) throw std::invalid_argument("a correlated value needs at least one component");
  if (settings.averaged < 2) throw std::invalid_argument("a level averages at least two values of the one before");
  if (settings.lags_per_level == 0 || settings.lags_per_level % settings.averaged != 0)
    throw std::invalid_argument("the lags per level must be a multiple of the values that are averaged");
  if (!(settings.longest_lag >= 0.0 && settings.longest_lag < 1e15))
    throw std::invalid_argument("the longest lag must be a number of samples, at most 1e15");
}

/// Scalar products of `b` with several `past` values: eight partial sums each, whatever their number.
template <std::size_t count>
void add_scalar_products(const double* b, const std::array<const double*, count>& past, std::size_t width,
                         double* products) {
  std::array<pairs::Lanes, count> sums;
  sums.fill(0.0);
  for (std::size_t c = 0; c < width; c += pairs::lane_count) {
    const pairs::Lanes of_b = pairs::load(b + c);
    for (std::size_t k = 0; k < count; ++k) sums[k] = fma(pairs::load(past[k] + c), of_b, sums[k]);
  }
  for (std::size_t k = 0; k < count; ++k) products[k] += reduce(sums[k]);
}

}  // namespace

struct MultipleTauCorrelator::Implementation {
  struct Level {
    std::size_t first_lag = 0;  // in values of this level
    std::int64_t count = 0;     // values so far
    Values recent_a;            // the last p, the one of number n at place n % p
    Values first_b;             // the first p - 1
    Values sum_a;               // of the values that no later level knows of: fewer than m, on the last level all
    Values sum_b;
    std::vector<double> products;  // per lag
  };

  Settings settings;
  std::size_t width;  // numbers per value in memory: whole registers, the last filled up with zeros
  std::vector<double> lags;
  std::vector<Level> levels;
  Reference reference;
  Values next_a;  // the sample that comes in, from the reference
  Values next_b;

  // Of the series that were merged; no lags before there are any.
  std::int64_t merged_samples = 0;
  PairSums merged;

  explicit Implementation(const Settings& wanted) : settings(wanted) {
    check(settings);
    constexpr std::size_t lanes = pairs::lane_count;
    const std::size_t p = settings.lags_per_level;
    width = settings.components == 1 ? 1 : (settings.components + lanes - 1) / lanes * lanes;
    next_a.resize(width);
    next_b.resize(width);
    reference.a.resize(settings.components);
    reference.b.resize(settings.components);
    double interval = 1.0;
    do {
      Level& level = levels.emplace_back();
      level.first_lag = levels.size() == 1 ? 0 : p / settings.averaged;
      level.recent_a.resize(p * width);
      level.first_b.resize((p - 1) * width);
      level.sum_a.resize(width);
      level.sum_b.resize(width);
      level.products.resize(p);
      for (std::size_t k = level.first_lag; k < p; ++k) lags.push_back(static_cast<double>(k) * interval);
      interval *= static_cast<double>(settings.averaged);
    } while (lags.back() < settings.longest_lag);
  }

  std::int64_t samples() const { return levels.front().count + merged_samples; }

  void add(std::span<const double> a, std::span<const double> b) {
    if (samples() == 0) {
      std::copy(a.begin(), a.end(), reference.a.begin());
      std::copy(b.begin(), b.end(), reference.b.begin());
    }
    for (std::size_t c = 0; c < settings.components; ++c) {
      next_a[c] = a[c] - reference.a[c];
      next_b[c] = b[c] - reference.b[c];
    }
    const auto m = static_cast<std::int64_t>(settings.averaged);
    take(levels[0], next_a.data(), next_b.data());
    for (std::size_t l = 0; l + 1 < levels.size() && levels[l].count % m == 0; ++l) {
      Level& level = levels[l];
      for (Values* sum : {&level.sum_a, &level.sum_b}) {
        for (double& value : *sum) value /= static_cast<double>(m);
      }
      take(levels[l + 1], level.sum_a.data(), level.sum_b.data());
      for (Values* sum : {&level.sum_a, &level.sum_b}) std::fill(sum->begin(), sum->end(), 0.0);
    }
  }

  /// The next value of a level.
  void take(Level& level, const double* a, const double* b) const {
    const std::size_t p = settings.lags_per_level;
    const auto number = static_cast<std::size_t>(level.count);
    const std::size_t newest = number % p;
    std::copy_n(a, width, level.recent_a.data() + newest * width);
    if (number + 1 < p) std::copy_n(b, width, level.first_b.data() + number * width);
    for (std::size_t c = 0; c < width; ++c) {
      level.sum_a[c] += a[c];
      level.sum_b[c] += b[c];
    }
    const std::size_t end = std::min(p, number + 1);
    const auto past = [&](std::size_t k) {
      return level.recent_a.data() + (k <= newest ? newest - k : newest + p - k) * width;
    };
    double* const products = level.products.data();
    std::size_t k = level.first_lag;
    if (width == 1) {
      for (; k < end; ++k) products[k] += *past(k) * *b;
    } else {
      for (; k + 4 <= end; k += 4) {
        add_scalar_products<4>(b, {past(k), past(k + 1), past(k + 2), past(k + 3)}, width, products + k);
      }
      for (; k < end; ++k) add_scalar_products<1>(b, {past(k)}, width, products + k);
    }
    ++level.count;
  }

  /// Of all series.
  PairSums sums() const {
    const std::size_t components = settings.components;
    const std::size_t p = settings.lags_per_level;
    const auto m = static_cast<double>(settings.averaged);
    PairSums result(lags.size(), components);
    Values total_a(width);  // of all values of a level, from the last level on
    Values total_b(width);
    std::size_t place = lags.size();  // of the level's first lag among all
    for (std::size_t l = levels.size(); l-- > 0;) {
      const Level& level = levels[l];
      for (std::size_t c = 0; c < width; ++c) {
        total_a[c] = m * total_a[c] + level.sum_a[c];
        total_b[c] = m * total_b[c] + level.sum_b[c];
      }
      Values left_a = total_a;  // of the first n - k values
      Values left_b = total_b;  // of the last n - k
      place -= p - level.first_lag;
      const auto count = static_cast<std::size_t>(level.count);
      for (std::size_t k = 0; k < std::min(p, count); ++k) {
        if (k > 0) {
          const double* const last = level.recent_a.data() + (count - k) % p * width;
          const double* const first = level.first_b.data() + (k - 1) * width;
          for (std::size_t c = 0; c < width; ++c) {
            left_a[c] -= last[c];
            left_b[c] -= first[c];
          }
        }
        if (k < level.first_lag) continue;
        const std::size_t at = place + k - level.first_lag;
        result.pairs[at] = static_cast<std::int64_t>(count - k);
        result.product[at] = level.products[k];
        std::copy_n(left_a.begin(), components, result.a.data() + at * components);
        std::copy_n(left_b.begin(), components, result.b.data() + at * components);
      }
    }
    if (merged_samples > 0) result.pool(merged, reference, reference);
    return result;
  }
};

MultipleTauCorrelator::MultipleTauCorrelator(const Settings& settings)
    : self_(std::make_unique<Implementation>(settings)) {}
MultipleTauCorrelator::~MultipleTauCorrelator() = default;
MultipleTauCorrelator::MultipleTauCorrelator(MultipleTauCorrelator&&) noexcept = default;
MultipleTauCorrelator& MultipleTauCorrelator::operator=(MultipleTauCorrelator&&) noexcept = default;

void MultipleTauCorrelator::add(std::span<const double> a, std::span<const double> b) {
  if (a.size() != self_->settings.components || b.size() != self_->settings.components)
    throw std::invalid_argument("a correlated value has another number of components than was announced");
  self_->add(a, b);
}

Correlation MultipleTauCorrelator::result(Means means) const {
  return self_->sums().correlation(self_->lags, self_->reference, means);
}

std::int64_t MultipleTauCorrelator::samples() const { return self_->samples(); }

void MultipleTauCorrelator::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.settings);
  archive.put_sequence(self.reference.a);
  archive.put_sequence(self.reference.b);
  for (const Implementation::Level& level : self.levels) {
    archive.put(level.count);
    for (const Values* values : {&level.recent_a, &level.first_b, &level.sum_a, &level.sum_b}) {
      archive.put_sequence(*values);
    }
    archive.put_sequence(level.products);
  }
  archive.put(self.merged_samples);
  if (self.merged_samples > 0) self.merged.save(archive);
}

void MultipleTauCorrelator::load(ArchiveReader& archive) {
  if (archive.get<Settings>() != self_->settings)
    throw RunFailed("a saved multiple-tau correlation function is of other settings than those asked for");
  auto loaded = std::make_unique<Implementation>(self_->settings);
  load_values(archive, loaded->reference.a);
  load_values(archive, loaded->reference.b);
  for (Implementation::Level& level : loaded->levels) {
    level.count = archive.get<std::int64_t>();
    for (Values* values : {&level.recent_a, &level.first_b, &level.sum_a, &level.sum_b}) {
      load_values(archive, *values);
    }
    load_values(archive, level.products);
  }
  loaded->merged_samples = archive.get<std::int64_t>();
  if (loaded->merged_samples > 0) {
    loaded->merged = PairSums(self_->lags.size(), self_->settings.components);
    loaded->merged.load(archive);
  }
  self_ = std::move(loaded);
}

void MultipleTauCorrelator::merge(const MultipleTauCorrelator& other) {
  Implementation& self = *self_;
  if (self.settings != other.self_->settings)
    throw std::invalid_argument("correlation functions of different settings cannot be merged");
  if (other.samples() == 0) return;
  const PairSums sums = other.self_->sums();
  const std::int64_t samples = other.samples();
  if (self.samples() == 0) self.reference = other.self_->reference;
  if (self.merged_samples == 0) self.merged = PairSums(self.lags.size(), self.settings.components);
  self.merged.pool(sums, other.self_->reference, self.reference);
  self.merged_samples += samples;
}

}  // namespace lucy::measure

// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/real_transform.hpp"

#include <fftw3.h>

#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

namespace lucy::measure {

namespace {

fftw_complex* as_fftw(RealTransform::Spectrum& spectrum) { return reinterpret_cast<fftw_complex*>(spectrum.data()); }

}  // namespace

struct RealTransform::Plans {
  fftw_plan forward = nullptr;
  fftw_plan backward = nullptr;

  ~Plans() {
    fftw_destroy_plan(forward);
    fftw_destroy_plan(backward);
  }
};

RealTransform::RealTransform(std::size_t length) : length_(length), plans_(std::make_unique<Plans>()) {
  // Any arrays of the same alignment will do at execution.
  Sequence x(length);
  Spectrum spectrum(frequencies());
  if (length <= static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    const auto size = static_cast<int>(length);
    plans_->forward = fftw_plan_dft_r2c_1d(size, x.data(), as_fftw(spectrum), FFTW_ESTIMATE);
    plans_->backward = fftw_plan_dft_c2r_1d(size, as_fftw(spectrum), x.data(), FFTW_ESTIMATE);
  }
  if (!plans_->forward || !plans_->backward)
    throw std::invalid_argument("FFTW has no transform of length " + std::to_string(length));
}

RealTransform::~RealTransform() = default;

std::shared_ptr<const RealTransform> RealTransform::of(std::size_t length) {
  // Kept to the end: to plan takes as long as hundreds of transforms. FFTW makes plans one thread at a time, and nobody
  // else makes or destroys any; their execution may overlap.
  static std::mutex mutex;
  static std::map<std::size_t, std::shared_ptr<const RealTransform>> known;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const RealTransform>& transform = known[length];
  if (!transform) transform.reset(new RealTransform(length));
  return transform;
}

void RealTransform::forward(const Sequence& x, Spectrum& spectrum) const {
  // Transforms out of place keep a real input; FFTW's interface is older than const.
  fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(x.data()), as_fftw(spectrum));
}

void RealTransform::backward(Spectrum& spectrum, Sequence& x) const {
  fftw_execute_dft_c2r(plans_->backward, as_fftw(spectrum), x.data());
}

}  // namespace lucy::measure

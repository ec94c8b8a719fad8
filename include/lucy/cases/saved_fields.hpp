// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a saved state, or their average over many, on a regular grid: measure/fields.hpp for frames.
// An average over time is one of rho, rho v, rho v^2 and rho e at the nodes, which stay where they are; the spectra are
// those of every single frame, averaged.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lucy/cases/frame.hpp"
#include "lucy/kernel/weight.hpp"
#include "lucy/measure/field_spectrum.hpp"
#include "lucy/measure/fields.hpp"

namespace lucy::cases {

struct FieldSettings {
  kernel::WeightName weight = kernel::WeightName::lucy;
  double range = 3.0;  ///< h
  double strain_rate = 0.0;
  measure::Medium medium;  ///< nothing: atoms
  measure::Grid grid;
};

/// Of one component of a field: "density", "velocity_smoothed_x", ... Of sheared particles the smoothed velocity is the
/// peculiar one ("velocity_smoothed_peculiar_x"), since the laboratory's is not periodic.
struct NamedSpectrum {
  std::string field;
  std::vector<measure::SpectrumRing> rings;
};

struct SavedFields {
  std::size_t particles = 0;
  std::size_t frames = 0;   ///< that were averaged
  std::int64_t step = 0;    ///< of the last
  double time = 0.0;        ///< of the last
  double first_time = 0.0;  ///< of the first
  double offset = 0.0;      ///< of the last: x-shift of the image above
  std::vector<measure::Field> fields;
  std::vector<NamedSpectrum> spectra;
  double spectra_whole_up_to = 0.0;           ///< |k|
  measure::KineticEnergies kinetic_energies;  ///< per particle, peculiar; individual and smoothed are means over frames

  /// Of a single frame, by particle number; empty in an average.
  std::vector<double> position;             ///< x0 y0 x1 y1 ...
  std::vector<double> velocity_individual;  ///< laboratory
  std::vector<double> velocity_smoothed;    ///< laboratory, at the particles
  std::vector<double> internal_energy;      ///< per mass; empty for atoms
  std::vector<double> density;
};

class FieldAverage {
 public:
  /// Throws BadInput for a range that is not above zero, and for a grid of fewer than 2 x 2 nodes.
  explicit FieldAverage(const FieldSettings& settings);
  ~FieldAverage();

  /// Frames of the same particles in the box of the grid. Throws BadInput when they are not, and when that box is
  /// shorter than the range.
  void add(const Frame& frame);
  /// After at least one frame.
  SavedFields result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lucy::cases

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"
#include "simulate/law.hpp"
#include "simulate/simulation.hpp"

namespace plumb::offline::sim {

/// The part of the shifts of measured points that geometry can explain, that is by constant twists
/// of the base, behind every joint, and of the tool. Of many rows only about 4000, evenly picked,
/// are used.
class Visible {
 public:
  Visible(const World& world, const std::array<bool, 3>& measured_axes);

  int rank() const { return static_cast<int>(basis_.cols()); }

  /// The RMS per axis of shifts, shape (rows, 3) [m], in any constant frame: of all of the shift,
  /// and of what remains after geometry was fitted to it.
  EffectSize size_of(const Rows3& shift_M) const;

 private:
  Eigen::VectorXd stacked(const Rows3& shift_M) const;

  std::vector<int> picked_;
  std::vector<int> axes_;
  Eigen::MatrixXd basis_;  // orthonormal columns
};

}  // namespace plumb::offline::sim

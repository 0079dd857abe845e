// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"
#include "simulate/law.hpp"

namespace plumb::offline::sim {

/// What geometry can explain of shifts of the measured points: constant twists of the base, behind
/// every joint and of the tool. Of many rows, evenly picked ones stand for all (about 4000).
class Visible {
 public:
  Visible(const World& world, const std::array<bool, 3>& measured_axes);

  int rank() const { return static_cast<int>(basis_.cols()); }

  /// Per-axis RMS of shifts, shape (rows, 3) [m], in any frame of the measurement: all of them,
  /// and what is left of them after geometry has been fitted to them.
  EffectSize size_of(const Rows3& shift_M) const;

 private:
  Eigen::VectorXd stacked(const Rows3& shift_M) const;

  std::vector<int> picked_;
  std::vector<int> axes_;
  Eigen::MatrixXd basis_;  // orthonormal columns
};

}  // namespace plumb::offline::sim

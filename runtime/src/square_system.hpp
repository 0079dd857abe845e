// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "scaled_jacobian.hpp"

namespace plumb::internal {

/// J dq = r for an arm of six joints.
///
/// Solved by elimination among the columns, each step by the column whose entry in its row is the
/// largest. Cost: the same whatever the numbers are.
class SquareSystem {
 public:
  /// Brings the columns of J to a lower triangle. J: of six joints.
  void eliminate(const ScaledJacobian& J) noexcept;

  /// The step dq that makes J dq = r, as far as there is one: along a direction that the arm cannot
  /// move in, singular values below 1e-7, it does not move.
  /// left: what of r stays.
  void solve(const TipMotion& r, JointSteps& dq, TipMotion& left) const noexcept;

  /// Of the determinant: -1, 0 or +1.
  int determinant_sign() const noexcept { return (determinant_ > 0.0) - (determinant_ < 0.0); }

 private:
  std::array<TipMotion, 6> column_;
  std::array<std::array<double, 6>, 6> factor_;  // of the chosen column k taken from another
  std::array<double, 6> inverse_;                // of the chosen entries; 0: none is there
  std::array<std::size_t, 6> chosen_;            // what column k changed places with; 5 with itself
  double determinant_;
};

}  // namespace plumb::internal

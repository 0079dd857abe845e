// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "scaled_jacobian.hpp"

namespace plumb::internal {

/// Solves J dq = r for an arm of six joints.
///
/// The columns are eliminated one after the other; the pivot of each row is its largest element.
/// Cost: the same whatever the numbers are.
class SquareSystem {
 public:
  /// Reduces the columns of J to a lower triangular matrix. J must have six joints.
  void eliminate(const ScaledJacobian& J) noexcept;

  /// Finds the step dq with J dq = r as far as possible: it has no component in directions in which
  /// the arm cannot move (pivots below 1e-7). left: the part of r that remains.
  void solve(const TipMotion& r, JointSteps& dq, TipMotion& left) const noexcept;

  /// How joint j moves for a unit translation of the tip along each axis that keeps the rotation:
  /// out[j], the first three columns of the inverse of J. Tiny pivots as in solve(). The fourth
  /// lanes are arbitrary.
  void joints_per_translation(std::array<Lanes, 6>& out) const noexcept;

  /// Sign of the determinant of J: -1, 0 or +1.
  int determinant_sign() const noexcept { return (determinant_ > 0.0) - (determinant_ < 0.0); }

 private:
  std::array<TipMotion, 6> column_;
  std::array<std::array<double, 6>, 6> factor_;  // [k][j]: multiple of column k subtracted from j
  std::array<double, 6> inverse_;                // 1 / pivot; 0 if the pivot is tiny
  std::array<std::size_t, 6> chosen_;            // column that was exchanged with column k
  double determinant_;
};

}  // namespace plumb::internal

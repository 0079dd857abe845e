// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "normal_equations.hpp"

namespace plumb::internal {

/// J dq = r for an arm of six joints: a column a joint, rows 0-2 translation, 3-5 rotation.
///
/// Solved by elimination among the columns, each step by the column whose entry in its row is the
/// largest. Cost: the same whatever the numbers are.
class SquareSystem {
 public:
  /// Columns of the Jacobian of six joints: translations by `moving`, rotations by `turning`, two
  /// states of one arm. Translations of revolute joints are multiplied with `per_length`, so that
  /// metres and radians compare.
  SquareSystem(const Chain& chain, const ChainFrames& moving, const ChainFrames& turning,
               double per_length) noexcept;

  /// Brings the columns to a lower triangle; once, before what follows.
  void eliminate() noexcept;

  /// The step that makes J dq = r, as far as there is one: along a direction that the arm cannot
  /// move in, singular values below 1e-7, it does not move.
  /// left: what of r stays.
  Vector6 solve(const Vector6& r, Vector6& left) const noexcept;

  /// Of the determinant: -1, 0 or +1.
  int determinant_sign() const noexcept { return sign_; }

 private:
  std::size_t choose(std::size_t row) noexcept;
  void set(std::size_t j, const Vector3& translation, const Vector3& rotation) noexcept;

  std::array<Matrix6::Column, 6> column_;
  std::array<std::array<double, 6>, 6> factor_;  // of the chosen column k taken from another
  std::array<double, 6> inverse_;                // of the chosen entries; 0: none is there
  std::array<std::uint8_t, 6> order_{0, 1, 2, 3, 4, 5};
  int sign_ = 1;
};

}  // namespace plumb::internal

// SPDX-License-Identifier: Apache-2.0
#include "square_system.hpp"

#include <algorithm>
#include <cstring>

#include "finite.hpp"

namespace plumb::internal {
namespace {

constexpr double kTiny = 1e-7;  // singular values below it are rounding, not geometry

/// Entry of a column, read where it stands.
double entry(const TipMotion& column, std::size_t row) noexcept {
  const std::size_t lane = row < 3 ? row : row + 1;
  double out;
  std::memcpy(&out, reinterpret_cast<const std::byte*>(&column) + lane * sizeof out, sizeof out);
  return out;
}

}  // namespace

/// The column with the largest entry of this row, among those that are left.
std::size_t SquareSystem::choose(std::size_t row) noexcept {
  std::size_t best = row;
  std::uint64_t largest = magnitude_key(entry(column_[row], row));
  for (std::size_t j = row + 1; j < 6; ++j) {
    const std::uint64_t key = magnitude_key(entry(column_[j], row));
    best = key > largest ? j : best;
    largest = key > largest ? key : largest;
  }
  return best;
}

void SquareSystem::eliminate(const ScaledJacobian& J) noexcept {
  std::copy_n(J.columns().begin(), 6, column_.begin());
  determinant_ = 1.0;
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t best = choose(k);
    const TipMotion chosen = column_[best];
    const double pivot = entry(column_[best], k);
    column_[best] = column_[k];
    column_[k] = chosen;
    chosen_[k] = best;
    determinant_ *= best == k ? pivot : -pivot;
    const bool there = magnitude_key(pivot) > magnitude_key(kTiny);
    const double inverse = 1.0 / pivot;
    inverse_[k] = there ? inverse : 0.0;
    for (std::size_t j = k + 1; j < 6; ++j) {
      TipMotion& other = column_[j];
      const double share = entry(other, k) * inverse_[k];
      factor_[k][j] = share;
      if (k < 2) other.translation = other.translation - chosen.translation * share;
      other.rotation = other.rotation - chosen.rotation * share;
    }
  }
}

JointSteps SquareSystem::solve(const TipMotion& r, TipMotion& left) const noexcept {
  left = r;
  JointSteps z;
  std::fill(z.begin() + 6, z.end(), 0.0);
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    z[k] = (k < 3 ? left.translation[k] : left.rotation[k - 3]) * inverse_[k];
    if (k < 3) left.translation = left.translation - column_[k].translation * z[k];
    left.rotation = left.rotation - column_[k].rotation * z[k];
  }
#pragma GCC unroll 6
  for (std::size_t k = 6; k-- > 0;) {
    double sum = z[k];
    for (std::size_t j = k + 1; j < 6; ++j) sum -= factor_[k][j] * z[j];
    z[k] = z[chosen_[k]];
    z[chosen_[k]] = sum;
  }
  return z;
}

}  // namespace plumb::internal

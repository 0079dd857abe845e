// SPDX-License-Identifier: Apache-2.0
#include "square_system.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "uninitialised.hpp"

namespace plumb::internal {
namespace {

constexpr double kTiny = 1e-7;  // singular values below it are rounding, not geometry

// Choices are made by masks, because a compiler may turn a condition into a branch.
std::uint64_t bits(double x) noexcept { return std::bit_cast<std::uint64_t>(x); }
double negated_if_odd(std::uint64_t count, double x) noexcept {
  return std::bit_cast<double>(bits(x) ^ count << 63);
}

/// 1 / pivot in every lane, or 0 if the pivot is tiny. Computed in vector registers throughout.
Lanes inverse_if_there(double pivot) noexcept {
  const Packed x = packed(pivot);
  const PackedBits magnitude =
      reinterpret_cast<PackedBits>(x) & std::numeric_limits<std::int64_t>::max();
  const PackedBits tiny = reinterpret_cast<Packed>(magnitude) <= kTiny;
  return twice(reinterpret_cast<Packed>(reinterpret_cast<PackedBits>(1.0 / x) & ~tiny));
}

/// Element of a column, read from memory.
double entry(const TipMotion& column, std::size_t row) noexcept {
  static_assert(sizeof(TipMotion) == 8 * sizeof(double));
  const std::size_t lane = row < 3 ? row : row + 1;
  double out;
  std::memcpy(&out, reinterpret_cast<const std::byte*>(&column) + lane * sizeof out, sizeof out);
  return out;
}

/// The column with the largest element of this row among the remaining ones. The number of the
/// column replaces the last bits of the compared number, so elements that differ only there count
/// as equal.
std::size_t choose(const std::array<TipMotion, 6>& columns, std::size_t row) noexcept {
  constexpr std::uint64_t kNumber = 7, kLast = kNumber >> 1;
  std::uint64_t largest = 0;
  for (std::size_t j = row; j < 6; ++j)
    largest = std::max(largest, 2 * (bits(entry(columns[j], row)) & ~kLast) + j);
  return static_cast<std::size_t>(largest & kNumber);
}

}  // namespace

/// Rows above k are finished, so after the third step no translation is read any more.
void SquareSystem::eliminate(const ScaledJacobian& J) noexcept {
  const std::span<const TipMotion> columns = J.columns();
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) copy(columns[k], column_[k]);
  double determinant = 1.0;
  std::uint64_t exchanges = 0;
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t best = choose(column_, k);
    const double pivot = entry(column_[best], k);
    if (k < 3) std::swap(column_[k].translation, column_[best].translation);
    std::swap(column_[k].rotation, column_[best].rotation);
    const Lanes translation = column_[k].translation, rotation = column_[k].rotation;
    chosen_[k] = best;
    determinant *= pivot;
    exchanges += static_cast<std::uint64_t>(best != k);
    const Lanes inverse = inverse_if_there(pivot);
    inverse_[k] = inverse[0];
    for (std::size_t j = k + 1; j < 6; ++j) {
      TipMotion& other = column_[j];
      const Lanes share = broadcast(entry(other, k)) * inverse;
      factor_[k][j] = share[0];
      if (k < 2) other.translation = other.translation - translation * share;
      other.rotation = other.rotation - rotation * share;
    }
  }
  determinant_ = negated_if_odd(exchanges, determinant);
}

void SquareSystem::solve(const TipMotion& r, JointSteps& z, TipMotion& left) const noexcept {
  Lanes translation = r.translation, rotation = r.rotation;
  std::fill(z.begin() + 6, z.end(), 0.0);
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    z[k] = (k < 3 ? translation[k] : rotation[k - 3]) * inverse_[k];
    if (k < 3) translation = translation - column_[k].translation * z[k];
    rotation = rotation - column_[k].rotation * z[k];
  }
  left.translation = translation;
  left.rotation = rotation;
#pragma GCC unroll 6
  for (std::size_t k = 5; k-- > 0;) {
    double sum = z[k];
    for (std::size_t j = k + 1; j < 6; ++j) sum -= factor_[k][j] * z[j];
    z[k] = z[chosen_[k]];
    z[chosen_[k]] = sum;
  }
}

/// Like solve() for three unit translations at once, one in each lane.
void SquareSystem::joints_per_translation(std::array<Lanes, 6>& out) const noexcept {
  const Lanes none{0.0, 0.0, 0.0, 0.0};
  std::array<Lanes, 6> left{Lanes{1.0, 0.0, 0.0, 0.0},
                            Lanes{0.0, 1.0, 0.0, 0.0},
                            Lanes{0.0, 0.0, 1.0, 0.0},
                            none,
                            none,
                            none};
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    out[k] = left[k] * inverse_[k];
    for (std::size_t i = k + 1; i < 6; ++i) left[i] = left[i] - out[k] * entry(column_[k], i);
  }
#pragma GCC unroll 6
  for (std::size_t k = 5; k-- > 0;) {
    Lanes sum = out[k];
    for (std::size_t j = k + 1; j < 6; ++j) sum = sum - out[j] * factor_[k][j];
    copy(out[chosen_[k]], out[k]);
    copy(sum, out[chosen_[k]]);
  }
}

}  // namespace plumb::internal

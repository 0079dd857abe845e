// SPDX-License-Identifier: Apache-2.0
#include "square_system.hpp"

#include <algorithm>
#include <cstring>

#include "finite.hpp"

namespace plumb::internal {
namespace {

constexpr double kTiny = 1e-7;  // singular values below it are rounding, not geometry

/// Entry of a column, read where it stands.
double entry(const Matrix6::Column& column, std::size_t row) noexcept {
  double out;
  std::memcpy(&out, reinterpret_cast<const std::byte*>(&column) + row * sizeof out, sizeof out);
  return out;
}

}  // namespace

void SquareSystem::set(std::size_t j, const Vector3& translation,
                       const Vector3& rotation) noexcept {
  column_[j].top = Lanes{translation(0), translation(1), translation(2), rotation(0)};
  column_[j].bottom = Lanes{rotation(1), rotation(2), 0.0, 0.0};
}

SquareSystem::SquareSystem(const Chain& chain, const ChainFrames& moving,
                           const ChainFrames& turning, double per_length) noexcept {
  for (std::size_t j = 0; j < 6; ++j) {
    const double scale = chain.scale(static_cast<int>(j));
    const Transformd& X_BP = moving.joint[j];
    const Vector3 axis = X_BP.R.col(2) * scale;
    if (chain.revolute(static_cast<int>(j)))
      set(j, cross<double>(axis, moving.tip.p - X_BP.p) * per_length,
          turning.joint[j].R.col(2) * scale);
    else
      set(j, axis, Vector3::Zero());
  }
}

/// Moves the column with the largest entry of this row ahead of the others that are left.
std::size_t SquareSystem::choose(std::size_t row) noexcept {
  std::size_t best = row;
  std::uint64_t largest = 0;
  for (std::size_t k = row; k < 6; ++k) {
    const std::uint64_t key = magnitude_key(entry(column_[order_[k]], row));
    best = key > largest ? k : best;
    largest = key > largest ? key : largest;
  }
  sign_ = best == row ? sign_ : -sign_;
  const std::uint8_t chosen = order_[best];
  order_[best] = order_[row];
  order_[row] = chosen;
  return chosen;
}

void SquareSystem::eliminate() noexcept {
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    const Matrix6::Column chosen = column_[choose(k)];
    const double pivot = k < 4 ? chosen.top[k] : chosen.bottom[k - 4];
    const bool there = magnitude_key(pivot) > magnitude_key(kTiny);
    const double inverse = 1.0 / pivot;
    inverse_[k] = there ? inverse : 0.0;
    sign_ = pivot > 0.0 ? sign_ : pivot < 0.0 ? -sign_ : 0;
    for (std::size_t i = k + 1; i < 6; ++i) {
      Matrix6::Column& other = column_[order_[i]];
      const double share = entry(other, k) * inverse_[k];
      factor_[k][order_[i]] = share;
      if (k < 3) other.top = other.top - chosen.top * share;
      other.bottom = other.bottom - chosen.bottom * share;
    }
  }
}

Vector6 SquareSystem::solve(const Vector6& r, Vector6& left) const noexcept {
  Lanes top{r(0), r(1), r(2), r(3)}, bottom{r(4), r(5), 0.0, 0.0};
  std::array<double, 6> z;  // by joint
#pragma GCC unroll 6
  for (std::size_t k = 0; k < 6; ++k) {
    const Matrix6::Column& column = column_[order_[k]];
    const double share = (k < 4 ? top[k] : bottom[k - 4]) * inverse_[k];
    z[order_[k]] = share;
    top = top - column.top * share;
    bottom = bottom - column.bottom * share;
  }
  left << top[0], top[1], top[2], top[3], bottom[0], bottom[1];
  for (std::size_t k = 5; k-- > 0;) {
    double sum = z[order_[k]];
    for (std::size_t i = k + 1; i < 6; ++i) sum -= factor_[k][order_[i]] * z[order_[i]];
    z[order_[k]] = sum;
  }
  Vector6 out;
  for (int j = 0; j < 6; ++j) out(j) = z[static_cast<std::size_t>(j)];
  return out;
}

}  // namespace plumb::internal

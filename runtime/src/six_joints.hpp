// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "lanes.hpp"

namespace plumb::internal {

/// One number for each of six joints, in whole registers. If six numbers do not fill the last
/// register, it begins before the end of the previous one and repeats its last numbers, so that
/// every register is loaded and stored whole.
struct SixJoints {
  static constexpr std::size_t kRegisters = (6 + kPackedLanes - 1) / kPackedLanes;

  /// The joint that register r begins with.
  static constexpr std::size_t first(std::size_t r) {
    return std::min(r * kPackedLanes, 6 - kPackedLanes);
  }

  SixJoints() = default;

  /// Loads numbers that were just written in registers of four and of two. The second register is
  /// loaded in two halves, because a load across both writes would have to wait for them.
  explicit SixJoints(const double* from) {
    for (std::size_t r = 0; r < kRegisters; ++r) at[r] = load(from + first(r));
#ifdef __AVX__
    at[1] = load_halves(from + 2, from + 4);
#endif
  }

  /// Loads numbers that were written long before, in whole registers.
  static SixJoints constants(const double* from) {
    SixJoints out;
    for (std::size_t r = 0; r < kRegisters; ++r) out.at[r] = load(from + first(r));
    return out;
  }

  void store(double* to) const {
    for (std::size_t r = 0; r < kRegisters; ++r) plumb::store(at[r], to + first(r));
  }

  /// The numbers of the first four joints, and of the last four.
  Lanes front() const {
#ifdef __AVX__
    return at[0];
#else
    return {at[0], at[1]};
#endif
  }
  Lanes back() const {
#ifdef __AVX__
    return at[1];
#else
    return {at[1], at[2]};
#endif
  }

  /// The number of joint i in every lane.
  template <std::size_t i>
  Packed broadcast() const {
    constexpr std::size_t r = i / kPackedLanes;
    return spread_lane<i - first(r)>(at[r]);
  }

  friend SixJoints operator+(const SixJoints& a, const SixJoints& b) {
    SixJoints out;
    for (std::size_t r = 0; r < kRegisters; ++r) out.at[r] = a.at[r] + b.at[r];
    return out;
  }
  friend SixJoints operator*(const SixJoints& a, const SixJoints& b) {
    SixJoints out;
    for (std::size_t r = 0; r < kRegisters; ++r) out.at[r] = a.at[r] * b.at[r];
    return out;
  }

  std::array<Packed, kRegisters> at;
};

}  // namespace plumb::internal

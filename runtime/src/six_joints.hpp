// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "lanes.hpp"

namespace plumb::internal {

/// A number of each of six joints, in whole registers: where six do not fill the last one it begins
/// before the end of the one ahead, so that nothing is gathered, and repeats what stands there.
struct SixJoints {
  static constexpr std::size_t kRegisters = (6 + kPackedLanes - 1) / kPackedLanes;

  /// The joint that register r begins with.
  static constexpr std::size_t first(std::size_t r) {
    return std::min(r * kPackedLanes, 6 - kPackedLanes);
  }

  SixJoints() = default;

  /// As what was just written in registers of four and of two is read without waiting for it.
  explicit SixJoints(const double* from) {
    for (std::size_t r = 0; r < kRegisters; ++r) at[r] = load(from + first(r));
#ifdef __AVX__
    at[1] = load_halves(from + 2, from + 4);
#endif
  }

  /// By whole registers: of what was written long before.
  static SixJoints constants(const double* from) {
    SixJoints out;
    for (std::size_t r = 0; r < kRegisters; ++r) out.at[r] = load(from + first(r));
    return out;
  }

  void store(double* to) const {
    for (std::size_t r = 0; r < kRegisters; ++r) plumb::store(at[r], to + first(r));
  }

  /// Of the first four and of the last four.
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

  /// That of joint i in every lane.
  template <std::size_t i>
  Packed spread() const {
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "plumb/runtime/detail/wide.hpp"

namespace plumb {

/// One SIMD register of doubles. Its number of lanes depends on the machine; the results do not.
#ifdef __AVX__
inline constexpr std::size_t kPackedLanes = 4;
#else
inline constexpr std::size_t kPackedLanes = 2;
#endif
using Packed = double __attribute__((vector_size(kPackedLanes * sizeof(double))));
using PackedBits = std::int64_t __attribute__((vector_size(kPackedLanes * sizeof(double))));

/// Four numbers that are computed together, in one register or two. (GCC would move a vector type
/// that is longer than its registers through memory.)
#ifdef __AVX__
using Lanes = Packed;
#else
struct Lanes {
  Packed low, high;

  Lanes() = default;
  Lanes(double a, double b, double c, double d) : low{a, b}, high{c, d} {}
  Lanes(const Packed& first, const Packed& last) : low(first), high(last) {}
  double operator[](std::size_t i) const { return i < 2 ? low[i] : high[i - 2]; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.low * b.low, a.high * b.high};
  }
  friend Lanes operator*(const Lanes& a, double b) { return {a.low * b, a.high * b}; }
};
#endif
static_assert(sizeof(Lanes) == 4 * sizeof(double) && sizeof(Wide) == sizeof(Lanes));

inline Packed load(const double* from) {
  Packed out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

template <class Register>
void store(Register numbers, void* to) {
  std::memcpy(to, &numbers, sizeof numbers);
}

/// Loads four consecutive numbers.
inline Lanes lanes(const double* from) {
#ifdef __AVX__
  return load(from);
#else
  return {load(from), load(from + kPackedLanes)};
#endif
}

#ifdef __AVX__
using Half = double __attribute__((vector_size(2 * sizeof(double))));

/// Loads two consecutive numbers from each address.
inline Packed load_halves(const double* first, const double* last) {
  Half low, high;
  std::memcpy(&low, first, sizeof low);
  std::memcpy(&high, last, sizeof high);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
#endif

/// Loads the first `count` numbers, at most a whole register; the other lanes are zero.
inline Packed load_some(const double* from, std::size_t count) {
  if (count >= kPackedLanes) return load(from);
#ifdef __AVX__
  return Packed{from[0], count > 1 ? from[1] : 0.0, count > 2 ? from[2] : 0.0, 0.0};
#else
  return Packed{from[0], 0.0};
#endif
}

/// Stores the first `count` numbers, at most a whole register.
inline void store_some(const Packed& numbers, double* to, std::size_t count) {
  if (count >= kPackedLanes) return store(numbers, to);
  for (std::size_t lane = 0; lane < count; ++lane) to[lane] = numbers[lane];
}

/// A register with the same number in every lane.
#ifdef __AVX__
inline Packed packed(double x) { return Packed{x, x, x, x}; }
inline Lanes twice(const Packed& same) { return same; }
#else
inline Packed packed(double x) { return Packed{x, x}; }
inline Lanes twice(const Packed& same) { return {same, same}; }
#endif
inline Lanes broadcast(double x) { return twice(packed(x)); }

inline Lanes operator*(const Lanes& a, const Wide& b) { return a * lanes(b.copies.data()); }

/// A register with the number of lane kLane in every lane.
template <std::size_t kLane>
Packed spread_lane(const Packed& x) {
#ifdef __AVX__
  return __builtin_shufflevector(x, x, kLane, kLane, kLane, kLane);
#else
  return __builtin_shufflevector(x, x, kLane, kLane);
#endif
}

#ifndef __AVX__
template <std::size_t kLane>
Lanes spread_lane(const Lanes& x) {
  return twice(spread_lane<kLane % 2>(kLane < 2 ? x.low : x.high));
}
#endif

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "lanes.hpp"

/// Comparisons and choices lane by lane, without a branch.
namespace plumb {

/// Bitwise a & b. With integer vectors GCC would load a constant through a general register, in
/// three instructions.
inline Packed common_bits(const Packed& a, const Packed& b) {
#if defined(__AVX__) && !defined(__clang__)
  return __builtin_ia32_andpd256(a, b);
#else
  return reinterpret_cast<Packed>(reinterpret_cast<PackedBits>(a) &
                                  reinterpret_cast<PackedBits>(b));
#endif
}

inline Packed magnitude(const Packed& x) {
  return common_bits(x, packed(std::bit_cast<double>(std::numeric_limits<std::int64_t>::max())));
}

/// All ones in each lane whose magnitude is at most `limit`, else zero; zero for NaN.
inline PackedBits within(const Packed& x, double limit) { return magnitude(x) <= packed(limit); }

/// All ones in each lane that is +0 or -0, else zero.
inline PackedBits zero(const Packed& x) { return x == packed(0.0); }

/// All ones in each lane that is greater than `limit`, else zero, also for NaN.
inline PackedBits above(const Packed& x, double limit) {
#ifdef __AVX__  // for x > y that is then or-ed GCC would generate a blend, one instruction more
  constexpr int kGreater = 30;
  return reinterpret_cast<PackedBits>(__builtin_ia32_cmppd256(x, packed(limit), kGreater));
#else
  return x > packed(limit);
#endif
}

/// True if every lane is all ones. Each lane must be all ones or zero.
inline bool all(const PackedBits& x) {
#if defined(__AVX__)
  return __builtin_ia32_movmskpd256(reinterpret_cast<Packed>(x)) == 15;
#elif defined(__SSE2__)
  return __builtin_ia32_movmskpd(reinterpret_cast<Packed>(x)) == 3;
#else
  return (x[0] & x[1]) != 0;
#endif
}
#ifndef __AVX__
inline PackedBits within(const Lanes& x, double limit) {
  return within(x.low, limit) & within(x.high, limit);
}
inline PackedBits zero(const Lanes& x) { return zero(x.low) & zero(x.high); }
#endif

/// Lane by lane: a, or b where a is NaN.
inline Packed known_or(const Packed& a, const Packed& b) { return a == a ? a : b; }
#ifndef __AVX__
inline Lanes known_or(const Lanes& a, const Lanes& b) {
  return {known_or(a.low, b.low), known_or(a.high, b.high)};
}
#endif

/// Lane by lane: `even` where the integer `number` is even, else `odd`.
inline Packed by_parity(const PackedBits& number, const Packed& even, const Packed& odd) {
#ifdef __AVX__
  return __builtin_ia32_blendvpd256(even, odd, reinterpret_cast<Packed>(number << 63));
#else
  const PackedBits e = reinterpret_cast<PackedBits>(even), o = reinterpret_cast<PackedBits>(odd);
  return reinterpret_cast<Packed>(e ^ ((e ^ o) & -(number & 1)));
#endif
}

/// The larger number of each lane; b where either is NaN. GCC recognises this instruction in a
/// choice only if neither operand is a constant.
inline Packed larger(const Packed& a, const Packed& b) {
#if defined(__AVX__)
  return __builtin_ia32_maxpd256(a, b);
#elif defined(__SSE2__)
  return __builtin_ia32_maxpd(a, b);
#else
  return a > b ? a : b;
#endif
}

/// The smaller number of each lane; b where either is NaN.
inline Packed smaller(const Packed& a, const Packed& b) {
#if defined(__AVX__)
  return __builtin_ia32_minpd256(a, b);
#elif defined(__SSE2__)
  return __builtin_ia32_minpd(a, b);
#else
  return a < b ? a : b;
#endif
}

/// Clamps each lane to [low, high]; NaN gives `low`.
inline Lanes clamped(const Lanes& x, const Lanes& low, const Lanes& high) {
#ifdef __AVX__
  return smaller(larger(x, low), high);
#else
  return {smaller(larger(x.low, low.low), high.low), smaller(larger(x.high, low.high), high.high)};
#endif
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "lanes.hpp"

/// Shuffles of lanes, for vectors (x, y, z in the first three lanes) and small matrices.
namespace plumb {

/// Lanes i, j, k, l of `a`, in this order.
template <int i, int j, int k, int l>
Lanes shuffle(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(a, a, i, j, k, l);
#else
  return {a[i], a[j], a[k], a[l]};
#endif
}

/// (a, x, y, z) -> (x, y, z, a). With it the last three numbers of an array are read as a register
/// that does not reach beyond the array.
inline Lanes last_three(const Lanes& end) { return shuffle<1, 2, 3, 0>(end); }

/// (x, y, z, a) -> (a, x, y, z), the inverse of last_three.
inline Lanes to_end(const Lanes& a) { return shuffle<3, 0, 1, 2>(a); }

/// (x, y, z, a) -> (1, x, y, z).
inline Lanes behind_one(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(packed(1.0), to_end(a), 0, 5, 6, 7);
#else
  return {1.0, a[0], a[1], a[2]};
#endif
}

/// (x, y, z) -> (y, z, x).
inline Lanes turned(const Lanes& a) { return shuffle<1, 2, 0, 3>(a); }

/// turned(cross_turned(a, b)) is a x b, so a sum of cross products needs only one `turned`.
inline Lanes cross_turned(const Lanes& a, const Lanes& b) { return a * turned(b) - turned(a) * b; }

inline Lanes cross(const Lanes& a, const Lanes& b) { return turned(cross_turned(a, b)); }

/// The first three rows of the matrix with columns a, b, c, d.
inline std::array<Lanes, 3> rows(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
#ifdef __AVX__
  const Lanes even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {__builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5),
          __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5),
          __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7)};
#else
  return {{{a[0], b[0], c[0], d[0]}, {a[1], b[1], c[1], d[1]}, {a[2], b[2], c[2], d[2]}}};
#endif
}

/// The four columns of the matrix with rows x, y, z. Their fourth lanes are arbitrary.
inline std::array<Lanes, 4> columns(const Lanes& x, const Lanes& y, const Lanes& z) {
#ifdef __AVX__
  const Lanes even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
  const Lanes odd = __builtin_shufflevector(x, y, 1, 5, 3, 7);
  const Lanes swapped = __builtin_shufflevector(z, z, 1, 0, 3, 2);
  return {__builtin_shufflevector(even, z, 0, 1, 4, 5),
          __builtin_shufflevector(odd, swapped, 0, 1, 4, 5),
          __builtin_shufflevector(even, z, 2, 3, 6, 7),
          __builtin_shufflevector(odd, swapped, 2, 3, 6, 7)};
#else
  return {Lanes{x[0], y[0], z[0], 0.0}, Lanes{x[1], y[1], z[1], 0.0}, Lanes{x[2], y[2], z[2], 0.0},
          Lanes{x[3], y[3], z[3], 0.0}};
#endif
}

/// The two columns of the matrix with rows x, y, z of two numbers each. Their fourth lanes are
/// arbitrary.
inline std::array<Lanes, 2> columns_of_two(const double* x, const double* y, const double* z) {
#ifdef __AVX__
  const Lanes outer = load_halves(x, z), inner = load_halves(y, y);
  return {__builtin_shufflevector(outer, inner, 0, 4, 2, 6),
          __builtin_shufflevector(outer, inner, 1, 5, 3, 7)};
#else
  return {Lanes{x[0], y[0], z[0], 0.0}, Lanes{x[1], y[1], z[1], 0.0}};
#endif
}

/// The columns of the matrix [v]x + d I; d is the same in all lanes.
inline std::array<Lanes, 3> cross_columns(const Lanes& v, const Lanes& d) {
#ifdef __AVX__
  constexpr std::int64_t kSign = std::numeric_limits<std::int64_t>::min();
  const auto signs = [](const Packed& x, const PackedBits& which) {
    return reinterpret_cast<Packed>(reinterpret_cast<PackedBits>(x) ^ which);
  };
  const Packed both = __builtin_shufflevector(v, d, 0, 1, 2, 7);
  return {signs(__builtin_shufflevector(both, both, 3, 2, 1, 0), PackedBits{0, 0, kSign, 0}),
          signs(__builtin_shufflevector(both, both, 2, 3, 0, 1), PackedBits{kSign, 0, 0, 0}),
          signs(__builtin_shufflevector(both, both, 1, 0, 3, 2), PackedBits{0, kSign, 0, 0})};
#else
  const double d0 = d[0];
  return {Lanes{d0, v[2], -v[1], 0.0}, Lanes{-v[2], d0, v[0], 0.0}, Lanes{v[1], -v[0], d0, 0.0}};
#endif
}

/// (a_0 b_1, a_1 b_1, a_1 b_2): the middle column of a b^T where a is a multiple of b, so that its
/// last element may be a_1 b_2 instead of a_2 b_1.
inline Lanes middle_products(const Lanes& a, const Lanes& b) {
  return shuffle<0, 1, 1, 1>(a) * shuffle<1, 1, 2, 2>(b);
}

}  // namespace plumb

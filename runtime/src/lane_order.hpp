// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "lanes.hpp"

/// Lanes in another order: vectors x, y, z in the first three of four, and small matrices.
namespace plumb {

/// These lanes of it, in this order.
template <int i, int j, int k, int l>
Lanes ordered(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(a, a, i, j, k, l);
#else
  return {a[i], a[j], a[k], a[l]};
#endif
}

/// (a, x, y, z) -> (x, y, z, a): what stands at the end of an array is read without what is behind.
inline Lanes last_three(const Lanes& end) { return ordered<1, 2, 3, 0>(end); }

/// (x, y, z, a) -> (a, x, y, z): the other way round.
inline Lanes to_end(const Lanes& a) { return ordered<3, 0, 1, 2>(a); }

/// (x, y, z, a) -> (1, x, y, z).
inline Lanes behind_one(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(packed(1.0), to_end(a), 0, 5, 6, 7);
#else
  return {1.0, a[0], a[1], a[2]};
#endif
}

/// (x, y, z) -> (y, z, x).
inline Lanes turned(const Lanes& a) { return ordered<1, 2, 0, 3>(a); }

/// Its `turned` is a x b; so a sum of cross products need be turned only once.
inline Lanes cross_turned(const Lanes& a, const Lanes& b) { return a * turned(b) - turned(a) * b; }

inline Lanes cross(const Lanes& a, const Lanes& b) { return turned(cross_turned(a, b)); }

/// The first three rows of the matrix with these columns.
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

/// Columns of three rows of four; what is in the fourth lane means nothing.
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

/// Columns of three rows of two; likewise.
inline std::array<Lanes, 2> columns_of_two(const double* x, const double* y, const double* z) {
#ifdef __AVX__
  const Lanes outer = load_halves(x, z), inner = load_halves(y, y);
  return {__builtin_shufflevector(outer, inner, 0, 4, 2, 6),
          __builtin_shufflevector(outer, inner, 1, 5, 3, 7)};
#else
  return {Lanes{x[0], y[0], z[0], 0.0}, Lanes{x[1], y[1], z[1], 0.0}};
#endif
}

/// The columns of [v]x + d, d the same in all lanes.
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

/// (a_0 b_1, a_1 b_1, a_1 b_2): a column of what is as good as a b^T and keeps its symmetry.
inline Lanes middle_products(const Lanes& a, const Lanes& b) {
  return ordered<0, 1, 1, 1>(a) * ordered<1, 1, 2, 2>(b);
}

}  // namespace plumb

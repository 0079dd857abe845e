// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "plumb/runtime/transform.hpp"
#include "plumb/runtime/wide.hpp"

namespace plumb {

/// As many numbers as the machine works on at once, lane by lane; the bits are the same everywhere.
#ifdef __AVX__
inline constexpr std::size_t kPackedLanes = 4;
#else
inline constexpr std::size_t kPackedLanes = 2;
#endif
using Packed = double __attribute__((vector_size(kPackedLanes * sizeof(double))));
using PackedBits = std::int64_t __attribute__((vector_size(kPackedLanes * sizeof(double))));

/// Four numbers worked on together: one register, or two. (GCC would take a vector that is longer
/// than its registers through memory.)
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

inline Packed load(const double* from) {
  Packed out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

template <class Register>
void store(Register numbers, void* to) {
  std::memcpy(to, &numbers, sizeof numbers);
}

/// Four numbers that stand one behind the other.
inline Lanes lanes(const double* from) {
#ifdef __AVX__
  return load(from);
#else
  return {load(from), load(from + kPackedLanes)};
#endif
}

/// One number in every lane.
#ifdef __AVX__
inline Packed packed(double x) { return Packed{x, x, x, x}; }
inline Lanes twice(const Packed& same) { return same; }
#else
inline Packed packed(double x) { return Packed{x, x}; }
inline Lanes twice(const Packed& same) { return {same, same}; }
#endif
inline Lanes spread(double x) { return twice(packed(x)); }

inline Lanes operator*(const Lanes& a, const Wide& b) { return a * lanes(b.copies.data()); }

/// Of integers, GCC would take a constant through a general register, in three steps.
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

/// The same in each lane that is zero, of either sign.
inline PackedBits zero(const Packed& x) { return x == packed(0.0); }

/// All ones in each lane that is greater than `limit`, else zero, also for NaN.
inline PackedBits above(const Packed& x, double limit) {
#ifdef __AVX__  // as GCC makes a choice, one step longer, of what is ored with a comparison
  constexpr int kGreater = 30;
  return reinterpret_cast<PackedBits>(__builtin_ia32_cmppd256(x, packed(limit), kGreater));
#else
  return x > packed(limit);
#endif
}

/// Whether all lanes are all ones; each is, or is zero.
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

#ifdef __AVX__
using Half = double __attribute__((vector_size(2 * sizeof(double))));

/// Two numbers from each.
inline Packed load_halves(const double* first, const double* last) {
  Half low, high;
  std::memcpy(&low, first, sizeof low);
  std::memcpy(&high, last, sizeof high);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
#endif

/// The first `count` numbers from there, and zeros; all of them if there are more.
inline Packed load_some(const double* from, std::size_t count) {
  if (count >= kPackedLanes) return load(from);
#ifdef __AVX__
  return Packed{from[0], count > 1 ? from[1] : 0.0, count > 2 ? from[2] : 0.0, 0.0};
#else
  return Packed{from[0], 0.0};
#endif
}

/// The first `count` numbers to there; all of them if there are fewer.
inline void store_some(const Packed& numbers, double* to, std::size_t count) {
  if (count >= kPackedLanes) return store(numbers, to);
  for (std::size_t lane = 0; lane < count; ++lane) to[lane] = numbers[lane];
}

/// Lane by lane; the second where either is NaN. GCC finds the instruction behind such a choice by
/// itself only where neither is a constant.
inline Packed larger(const Packed& a, const Packed& b) {
#if defined(__AVX__)
  return __builtin_ia32_maxpd256(a, b);
#elif defined(__SSE2__)
  return __builtin_ia32_maxpd(a, b);
#else
  return a > b ? a : b;
#endif
}

inline Packed smaller(const Packed& a, const Packed& b) {
#if defined(__AVX__)
  return __builtin_ia32_minpd256(a, b);
#elif defined(__SSE2__)
  return __builtin_ia32_minpd(a, b);
#else
  return a < b ? a : b;
#endif
}

/// Lane by lane within [low, high]; NaN gives `low`.
inline Lanes held(const Lanes& x, const Lanes& low, const Lanes& high) {
#ifdef __AVX__
  return smaller(larger(x, low), high);
#else
  return {smaller(larger(x.low, low.low), high.low), smaller(larger(x.high, low.high), high.high)};
#endif
}

/// The numbers of a pose: its three axes, then its origin.
inline const double* numbers(const Transformd& X_AB) {
  static_assert(sizeof(Transformd) == 12 * sizeof(double) && offsetof(Transformd, p) == 72);
  return reinterpret_cast<const double*>(&X_AB);
}
inline double* numbers(Transformd& X_AB) { return reinterpret_cast<double*>(&X_AB); }

/// Axis j of B in A, column j of the rotation; what is in the fourth lane means nothing.
inline Lanes axis(const Transformd& X_AB, std::size_t j) { return lanes(numbers(X_AB) + 3 * j); }

/// (a, x, y, z) -> (x, y, z, a): what stands at the end of an array is read without what is behind.
inline Lanes last_three(const Lanes& end) {
#ifdef __AVX__
  return __builtin_shufflevector(end, end, 1, 2, 3, 0);
#else
  return {end[1], end[2], end[3], end[0]};
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

/// The origin of B in A; likewise.
inline Lanes origin(const Transformd& X_AB) { return last_three(lanes(numbers(X_AB) + 8)); }

/// (x, y, z, a) -> (a, x, y, z): the other way round.
inline Lanes to_end(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(a, a, 3, 0, 1, 2);
#else
  return {a[3], a[0], a[1], a[2]};
#endif
}

/// (x, y, z, a) -> (1, x, y, z).
inline Lanes behind_one(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(packed(1.0), to_end(a), 0, 5, 6, 7);
#else
  return {1.0, a[0], a[1], a[2]};
#endif
}

/// By whole registers, all read before one is written.
inline void copy(const Transformd& from, Transformd& to) {
  const double* in = numbers(from);
  const Lanes begin = lanes(in), middle = lanes(in + 4), end = lanes(in + 8);
  store(begin, numbers(to));
  store(middle, numbers(to) + 4);
  store(end, numbers(to) + 8);
}

/// X_AB with the origin of B moved by d, in A; likewise.
inline Transformd moved(const Transformd& X_AB, const Lanes& d) {
  const double* in = numbers(X_AB);
  const Lanes begin = lanes(in), middle = lanes(in + 4), end = lanes(in + 8), sum = end + to_end(d);
  Transformd out;
  store(begin, numbers(out));
  store(middle, numbers(out) + 4);
  store(Lanes{end[0], sum[1], sum[2], sum[3]}, numbers(out) + 8);
  return out;
}

/// (x, y, z) -> (y, z, x).
inline Lanes turned(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(a, a, 1, 2, 0, 3);
#else
  return {a[1], a[2], a[0], a[3]};
#endif
}

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

/// Number k of it in every lane.
template <int k>
Lanes every(const Lanes& a) {
#ifdef __AVX__
  return __builtin_shufflevector(a, a, k, k, k, k);
#else
  return spread(a[k]);
#endif
}

/// Lane by lane the first; the second where that is NaN.
inline Packed known_or(const Packed& a, const Packed& b) { return a == a ? a : b; }
#ifndef __AVX__
inline Lanes known_or(const Lanes& a, const Lanes& b) {
  return {known_or(a.low, b.low), known_or(a.high, b.high)};
}
#endif

/// Its `turned` is a x b; so a sum of cross products need be turned only once.
inline Lanes cross_turned(const Lanes& a, const Lanes& b) { return a * turned(b) - turned(a) * b; }

inline Lanes cross(const Lanes& a, const Lanes& b) { return turned(cross_turned(a, b)); }

/// One lane in all of them.
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
#ifdef __AVX__
  return __builtin_shufflevector(a, a, 0, 1, 1, 1) * __builtin_shufflevector(b, b, 1, 1, 2, 2);
#else
  return Lanes{a[0], a[1], a[1], a[1]} * Lanes{b[1], b[1], b[2], b[2]};
#endif
}

/// Lane by lane: the first where the whole number is even, else the second.
inline Packed by_parity(const PackedBits& number, const Packed& even, const Packed& odd) {
#ifdef __AVX__
  return __builtin_ia32_blendvpd256(even, odd, reinterpret_cast<Packed>(number << 63));
#else
  const PackedBits e = reinterpret_cast<PackedBits>(even), o = reinterpret_cast<PackedBits>(odd);
  return reinterpret_cast<Packed>(e ^ ((e ^ o) & -(number & 1)));
#endif
}

/// A pose X_AB by its columns: the axes of B and its origin, in A; the fourth lane is 0 in an axis
/// and 1 in the origin.
class Columns {
 public:
  explicit Columns(const Transformd& X)
      : x_{X.R(0, 0), X.R(1, 0), X.R(2, 0), 0.0},
        y_{X.R(0, 1), X.R(1, 1), X.R(2, 1), 0.0},
        z_{X.R(0, 2), X.R(1, 2), X.R(2, 2), 0.0},
        p_{X.p(0), X.p(1), X.p(2), 1.0} {}

  Columns(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& p)
      : x_(x), y_(y), z_(z), p_(p) {}

  explicit Columns(const std::array<std::array<double, 4>, 4>& stored)
      : x_(lanes(stored[0].data())),
        y_(lanes(stored[1].data())),
        z_(lanes(stored[2].data())),
        p_(lanes(stored[3].data())) {}

  /// X_AB <- X_AB Rz.
  void turn(const Packed& sin, const Packed& cos) {
    const Lanes before = x_, s = twice(sin), c = twice(cos);
    x_ = before * c + y_ * s;
    y_ = y_ * c - before * s;
  }

  /// X_AB <- X_AB Tz.
  void slide(double length) { p_ = p_ + z_ * length; }

  /// X_AB <- X_AB X_BC.
  void append(const Transformd& X_BC) {
    const double* c = X_BC.R.data();
    const Lanes bx = x_, by = y_, bz = z_;
    x_ = bx * c[0] + by * c[1] + bz * c[2];
    y_ = bx * c[3] + by * c[4] + bz * c[5];
    z_ = bx * c[6] + by * c[7] + bz * c[8];
    p_ = (bx * X_BC.p(0) + by * X_BC.p(1) + bz * X_BC.p(2)) + p_;
  }

  /// X_AB <- X_AB Tz(d) Tx(a) Rx(alpha): the same numbers as by its matrix, without the zeros.
  void append_link(const Wide& d, const Wide& a, const Wide& sin_alpha, const Wide& cos_alpha) {
    const Lanes by = y_, bz = z_;
    p_ = (x_ * a + bz * d) + p_;
    y_ = by * cos_alpha + bz * sin_alpha;
    z_ = bz * cos_alpha - by * sin_alpha;
  }

  /// The point c of frame B, in A.
  Lanes point(const WidePoint& c) const { return x_ * c.x + y_ * c.y + z_ * c.z + p_; }

  /// Whole registers: each is written over the end of the one before.
  void store(Transformd& out) const {
    static_assert(sizeof(Transformd) == 12 * sizeof(double) && offsetof(Transformd, p) == 72);
    auto* bytes = reinterpret_cast<std::byte*>(&out);
    plumb::store(x_, bytes);
    plumb::store(y_, bytes + 3 * sizeof(double));
    plumb::store(z_, bytes + 6 * sizeof(double));
    plumb::store(Lanes{z_[2], p_[0], p_[1], p_[2]}, bytes + 8 * sizeof(double));
  }

  /// With fewer steps, where the number behind `out` may be written over.
  void store_over(Transformd& out) const {
    auto* bytes = reinterpret_cast<std::byte*>(&out);
    plumb::store(x_, bytes);
    plumb::store(y_, bytes + 3 * sizeof(double));
    plumb::store(z_, bytes + 6 * sizeof(double));
    plumb::store(p_, bytes + 9 * sizeof(double));
  }

  void store(std::array<std::array<double, 4>, 4>& out) const {
    plumb::store(x_, out[0].data());
    plumb::store(y_, out[1].data());
    plumb::store(z_, out[2].data());
    plumb::store(p_, out[3].data());
  }

  /// The axes, and the origin.
  const Lanes& x() const { return x_; }
  const Lanes& y() const { return y_; }
  const Lanes& z() const { return z_; }
  const Lanes& p() const { return p_; }

  Transformd pose() const {
    Transformd out;
    store(out);
    return out;
  }

 private:
  Lanes x_, y_, z_, p_;
};

}  // namespace plumb

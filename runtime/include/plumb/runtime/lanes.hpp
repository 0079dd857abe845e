// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "plumb/runtime/transform.hpp"

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
  friend Lanes operator*(const Lanes& a, double b) { return {a.low * b, a.high * b}; }
};
#endif

/// What a column of three numbers is kept in: doubles in lanes, of which the fourth means nothing.
template <class S>
struct ColumnOf {
  using type = Vec3<S>;
};
template <>
struct ColumnOf<double> {
  using type = Lanes;
};

/// A pose X_AB by its columns: the axes of B and its origin, in A.
template <class S>
struct Columns {
  using Column = typename ColumnOf<S>::type;
  Column x, y, z, p;

  explicit Columns(const Transformd& X) {
    set(x, X.R(0, 0), X.R(1, 0), X.R(2, 0));
    set(y, X.R(0, 1), X.R(1, 1), X.R(2, 1));
    set(z, X.R(0, 2), X.R(1, 2), X.R(2, 2));
    set(p, X.p(0), X.p(1), X.p(2));
  }

  /// X_AB <- X_AB Rz.
  void turn(const S& sin, const S& cos) {
    const Column before = x;
    x = before * cos + y * sin;
    y = y * cos - before * sin;
  }

  /// X_AB <- X_AB Tz.
  void slide(const S& length) { p = p + z * length; }

  /// X_AB <- X_AB X_BC.
  void append(const Transformd& X_BC) {
    const Column bx = x, by = y, bz = z;
    combine(bx, by, bz, X_BC.R.data(), x);
    combine(bx, by, bz, X_BC.R.data() + 3, y);
    combine(bx, by, bz, X_BC.R.data() + 6, z);
    Column shift;
    combine(bx, by, bz, X_BC.p.data(), shift);
    p = shift + p;
  }

  void store(Transform<S>& out) const {
    if constexpr (std::is_same_v<S, double>) {
      store_lanes(out);
    } else {
      for (int i = 0; i < 3; ++i) {
        out.R(i, 0) = x(i);
        out.R(i, 1) = y(i);
        out.R(i, 2) = z(i);
        out.p(i) = p(i);
      }
    }
  }

 private:
  static void set(Lanes& column, double a, double b, double c) { column = Lanes{a, b, c, 0.0}; }
  static void set(Vec3<S>& column, double a, double b,
                  double c) requires(!std::is_same_v<S, double>) {
    column = Vec3<S>(S(a), S(b), S(c));
  }
  static void combine(const Column& bx, const Column& by, const Column& bz, const double* c,
                      Column& out) {
    out = bx * S(c[0]) + by * S(c[1]) + bz * S(c[2]);
  }

  /// Whole registers: each is written over the meaningless end of the one before.
  void store_lanes(Transformd& out) const {
    static_assert(sizeof(Transformd) == 12 * sizeof(double) && offsetof(Transformd, p) == 72);
    const Lanes end{z[2], p[0], p[1], p[2]};
    auto* bytes = reinterpret_cast<std::byte*>(&out);
    std::memcpy(bytes, &x, sizeof x);
    std::memcpy(bytes + 3 * sizeof(double), &y, sizeof y);
    std::memcpy(bytes + 6 * sizeof(double), &z, sizeof z);
    std::memcpy(bytes + 8 * sizeof(double), &end, sizeof end);
  }
};

}  // namespace plumb

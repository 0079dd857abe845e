// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "lanes.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb {

/// A pose X_AB by its four columns: the axes of B and its origin, in A. The fourth lane is 0 in an
/// axis and 1 in the origin.
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

  /// X_AB <- X_AB Tz(d) Tx(a) Rx(alpha). The result equals that of append(), without multiplying by
  /// the zeros of the matrix.
  void append_link(const Wide& d, const Wide& a, const Wide& sin_alpha, const Wide& cos_alpha) {
    const Lanes by = y_, bz = z_;
    p_ = (x_ * a + bz * d) + p_;
    y_ = by * cos_alpha + bz * sin_alpha;
    z_ = bz * cos_alpha - by * sin_alpha;
  }

  /// The point c of frame B, in A.
  Lanes point(const WidePoint& c) const { return x_ * c.x + y_ * c.y + z_ * c.z + p_; }

  /// Stores in whole registers, each of which overwrites the end of the one before.
  void store(Transformd& out) const {
    static_assert(sizeof(Transformd) == 12 * sizeof(double) && offsetof(Transformd, p) == 72);
    auto* bytes = reinterpret_cast<std::byte*>(&out);
    plumb::store(x_, bytes);
    plumb::store(y_, bytes + 3 * sizeof(double));
    plumb::store(z_, bytes + 6 * sizeof(double));
    plumb::store(Lanes{z_[2], p_[0], p_[1], p_[2]}, bytes + 8 * sizeof(double));
  }

  /// Stores with fewer instructions, and overwrites the number that follows `out`. To be used only
  /// where that number is written afterwards (docs/runtime-internals.md, "Overlapping writes").
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

  /// The columns: x, y and z axis, and origin.
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

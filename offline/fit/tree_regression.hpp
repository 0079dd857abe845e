// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace plumb::offline {

/// Smallest share of a column that must be independent of the others: worse than that, the design
/// has a condition of 1e7 or more and no leaf is made of it.
inline constexpr double kMinIndependentShare = 1e-7;

/// Running least squares of y on (1, u), sample by sample: rows are turned into the triangle
/// R = D^1/2 (unit upper) by plane rotations without square roots [Gentleman 1973, AS 75;
/// Miller 1992, AS 274]. As accurate as Householder QR on all rows, never worse for having passed
/// through a singular design, and the residual sum of squares only ever grows.
///
/// P: inputs. Scalar: double, or a pair of doubles for two regressions side by side.
/// Cost of `add`: P divisions and about 2 (P + 1) (P + 2) multiply-adds.
template <int P, class Scalar>
class Regression {
 public:
  Regression() {
    for (auto& d : diagonal_) d = splat(kEmpty);
    for (auto& row : unit_) row.fill(splat(0.0));
    mean_.fill(splat(0.0));
  }

  /// x: the P inputs, then y. Used as scratch.
  void add(std::array<Scalar, P + 1>& x) {
    const double n = ++count_;
    const Scalar share = splat(1.0 / n);
    for (int k = 0; k <= P; ++k) {
      x[k] = x[k] - mean_[k];
      mean_[k] = mean_[k] + x[k] * share;
    }
    Scalar weight = splat((n - 1.0) / n);
    for (int i = 0; i < P; ++i) {
      const Scalar weighted = weight * x[i];
      const Scalar grown = diagonal_[i] + weighted * x[i];
      const Scalar inverse = splat(1.0) / grown;
      const Scalar keep = diagonal_[i] * inverse;
      const Scalar gain = weighted * inverse;
      weight = weight * keep;
      diagonal_[i] = grown;
      for (int k = i + 1; k <= P; ++k) {
        const Scalar old = unit_[i][k];
        unit_[i][k] = keep * old + gain * x[k];
        x[k] = x[k] - x[i] * old;
      }
    }
    rss_ = rss_ + weight * x[P] * x[P];
  }

  int count() const { return count_; }
  const Scalar& rss() const { return rss_; }

  /// Squared norm of input i made orthogonal to the constant and the inputs before it.
  const Scalar& independent(int i) const { return diagonal_[i]; }

  /// Coefficients, the constant first. Meaningful if every input is independent enough.
  std::array<Scalar, P + 1> coefficients() const {
    std::array<Scalar, P + 1> w;
    Scalar constant = mean_[P];
    for (int i = P - 1; i >= 0; --i) {
      w[i + 1] = unit_[i][P];
      for (int k = i + 1; k < P; ++k) w[i + 1] = w[i + 1] - unit_[i][k] * w[k + 1];
      constant = constant - mean_[i] * w[i + 1];
    }
    w[0] = constant;
    return w;
  }

 private:
  static constexpr double kEmpty = 1e-300;  // nothing, but divisible
  static Scalar splat(double value) { return Scalar{} + value; }

  std::array<Scalar, P> diagonal_;
  std::array<std::array<Scalar, P + 1>, P> unit_;
  std::array<Scalar, P + 1> mean_;
  Scalar rss_ = splat(0.0);
  int count_ = 0;
};

}  // namespace plumb::offline

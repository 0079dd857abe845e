// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "plumb/format/limits.hpp"

namespace plumb::offline {

/// The smallest share of a column that must be independent of the others. With less, the condition
/// number of the design is 1e7 or more, and no leaf is made.
inline constexpr double kMinIndependentShare = 1e-7;

/// The number of regressors is not known at compile time.
inline constexpr int kAnyTerms = 0;

/// Running least squares of Y outputs on 1 and P terms, sample by sample: rows are turned into the
/// triangle R = D^1/2 (unit upper) by plane rotations without square roots [Gentleman 1973, AS 75;
/// Miller 1992, AS 274]. As accurate as Householder QR on all rows, never worse for having passed
/// through a singular design, and the residual sum of squares only ever grows.
///
/// P: terms besides the constant, or kAnyTerms. Scalar: double, or a pair of doubles for two
/// regressions side by side. Cost of `add`: P divisions, about 2 (P + 1) (P + 1 + Y) multiply-adds.
template <int P, int Y, class Scalar>
class Regression {
 public:
  static constexpr int kTerms = P == kAnyTerms ? format::kMaxLeafTerms - 1 : P;
  using Row = std::array<Scalar, kTerms + Y>;

  explicit Regression(int terms) : terms_(terms) {
    diagonal_.fill(splat(kEmpty));
    for (auto& row : unit_) row.fill(splat(0.0));
    mean_.fill(splat(0.0));
  }

  /// x: the terms, then the outputs. Used as scratch.
  void add(Row& x) {
    const int p = terms(), columns = p + Y;
    const double n = ++count_;
    const Scalar share = splat(1.0 / n);
    for (int k = 0; k < columns; ++k) {
      x[k] = x[k] - mean_[k];
      mean_[k] = mean_[k] + x[k] * share;
    }
    Scalar weight = splat((n - 1.0) / n);
    for (int i = 0; i < p; ++i) {
      const Scalar weighted = weight * x[i];
      const Scalar grown = diagonal_[i] + weighted * x[i];
      const Scalar inverse = splat(1.0) / grown;
      const Scalar keep = diagonal_[i] * inverse;
      const Scalar gain = weighted * inverse;
      weight = weight * keep;
      diagonal_[i] = grown;
      for (int k = i + 1; k < columns; ++k) {
        const Scalar old = unit_[i][k];
        unit_[i][k] = keep * old + gain * x[k];
        x[k] = x[k] - x[i] * old;
      }
    }
    for (int k = p; k < columns; ++k) rss_ = rss_ + weight * x[k] * x[k];
  }

  int count() const { return count_; }
  int terms() const { return P == kAnyTerms ? terms_ : P; }

  /// The residual sum of squares of all outputs together.
  const Scalar& rss() const { return rss_; }

  /// Squared norm of term i made orthogonal to the constant and the terms before it.
  const Scalar& independent(int i) const { return diagonal_[i]; }

  /// Coefficients of an output, the constant first. Meaningful if every term is independent enough.
  std::vector<Scalar> coefficients(int output) const {
    const int p = terms();
    std::vector<Scalar> w(p + 1);
    w[0] = mean_[p + output];
    for (int i = p - 1; i >= 0; --i) {
      w[i + 1] = unit_[i][p + output];
      for (int k = i + 1; k < p; ++k) w[i + 1] = w[i + 1] - unit_[i][k] * w[k + 1];
      w[0] = w[0] - mean_[i] * w[i + 1];
    }
    return w;
  }

 private:
  static constexpr double kEmpty = 1e-300;  // stands for zero, but can be divided by
  static Scalar splat(double value) { return Scalar{} + value; }

  std::array<Scalar, kTerms> diagonal_;
  std::array<std::array<Scalar, kTerms + Y>, kTerms> unit_;
  std::array<Scalar, kTerms + Y> mean_;
  Scalar rss_ = splat(0.0);
  int terms_ = 0;
  int count_ = 0;
};

}  // namespace plumb::offline

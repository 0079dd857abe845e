// SPDX-License-Identifier: Apache-2.0
#include "numbers/tails.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr int kMostTerms = 10000;
constexpr double kSmall = 1e-300;
constexpr double kExact = 1e-15;

double away_from_zero(double v) { return std::abs(v) < kSmall ? kSmall : v; }

/// The continued fraction of the incomplete beta function; converges for x < (p + 1) / (p + q + 2).
double fraction(double p, double q, double x) {
  double c = 1.0, d = 1.0 / away_from_zero(1.0 - (p + q) * x / (p + 1.0)), h = d;
  const auto step = [&](double term) {
    d = 1.0 / away_from_zero(1.0 + term * d);
    c = away_from_zero(1.0 + term / c);
    h *= c * d;
    return std::abs(c * d - 1.0);
  };
  for (int m = 1; m < kMostTerms; ++m) {
    step(m * (q - m) * x / ((p + 2.0 * m - 1.0) * (p + 2.0 * m)));
    if (step(-(p + m) * (p + q + m) * x / ((p + 2.0 * m) * (p + 2.0 * m + 1.0))) < kExact) break;
  }
  return h;
}

/// The logarithm of x^p y^q / B(p, q), where y = 1 - x.
double ln_front(double p, double q, double x, double y) {
  return std::lgamma(p + q) - std::lgamma(p) - std::lgamma(q) + p * std::log(x) + q * std::log(y);
}

}  // namespace

double ln_f_tail(double f, double a, double b) {
  if (!(f > 0.0)) return 0.0;
  const double p = b / 2.0, q = a / 2.0;
  const double x = b / (b + a * f), y = a * f / (b + a * f);
  if (!(x > 0.0)) return -1e9;
  if (!(y > 0.0)) return 0.0;
  if (x < (p + 1.0) / (p + q + 2.0))
    return std::min(0.0, ln_front(p, q, x, y) + std::log(fraction(p, q, x) / p));
  return std::log1p(-std::min(1.0, std::exp(ln_front(q, p, y, x)) * fraction(q, p, y) / q));
}

FTest f_test(double explained, double numbers, double left, double free) {
  const double ratio = explained / numbers / (left / free);
  return {ratio, ln_f_tail(ratio, numbers, free)};
}

double student_quantile(double share, double dof) {
  return boost::math::quantile(boost::math::students_t(dof), share);
}

}  // namespace plumb::offline

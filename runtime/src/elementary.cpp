// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/elementary.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sin_cos_packed.hpp"

// Polynomial coefficients: the minimax sets of FDLIBM 5.3 [Sun Microsystems 1993], which state an
// approximation error below 2^-57 on the reduced intervals.
namespace plumb::portable {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_nan(double x) { return x != x; }
double magnitude(double x) { return x < 0.0 ? -x : x; }

double nearest(double x) { return (x + kShift) - kShift; }

/// 2^k for -1022 <= k <= 1023.
double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// The arctangent for about |t| <= 7/16. Arguments 0 <= x <= 1 are reduced to it by atan(x) =
/// atan(c) + atan((x - c)/(1 + c x)).
double atan_polynomial(double t) {
  const double z = t * t;
  const double w = z * z;
  const double odd =
      z * (3.33333333333329318027e-01 +
           w * (1.42857142725034663711e-01 +
                w * (9.09088713343650656196e-02 +
                     w * (6.66107313738753120669e-02 +
                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double even =
      w * (-1.99999999998764832476e-01 +
           w * (-1.11111104054623557880e-01 +
                w * (-7.69187620504482999495e-02 +
                     w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return t * (odd + even);
}

/// A sum of two doubles that do not overlap.
struct Pair {
  double high;
  double low;
};

Pair fast_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

Pair sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// Exact product by Dekker's splitting, without a fused multiply-add.
Pair product(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1.0;
  const double p = a * b;
  const double at = kSplit * a, bt = kSplit * b;
  const double ah = at - (at - a), bh = bt - (bt - b);
  const double al = a - ah, bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

struct Split {
  double mantissa;  // sqrt(1/2) .. sqrt(2)
  double exponent;
};

Split split(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto shifted = bits - std::bit_cast<std::uint64_t>(0.70710678118654752440);
  const auto exponent = static_cast<std::int64_t>(shifted) >> 52;
  return {std::bit_cast<double>(bits - (static_cast<std::uint64_t>(exponent) << 52)),
          static_cast<double>(exponent)};
}

constexpr double kLn2High = 6.93147180369123816490e-01;  // 33 bits
constexpr double kLn2Low = 1.90821492927058770002e-10;

/// log of a normal x > 0 to about 2^-68, by s = f / (2 + f) and the series of atanh.
Pair log_pair(double x) {
  const auto [m, k] = split(x);
  const double f = m - 1.0;
  // s = f / (2 + f) in two parts.
  const Pair divisor = fast_sum(2.0, f);
  const double s = f / divisor.high;
  const Pair back = product(s, divisor.high);
  const double s_low = (((f - back.high) - back.low) - s * divisor.low) / divisor.high;
  const double z = s * s;
  // atanh(s)/s - 1 - z/3: Taylor to z^12, |z| <= 0.0295.
  const double tail =
      z * z *
      (1.0 / 5 +
       z * (1.0 / 7 +
            z * (1.0 / 9 + z * (1.0 / 11 +
                                z * (1.0 / 13 +
                                     z * (1.0 / 15 + z * (1.0 / 17 + z * (1.0 / 19 + z / 21))))))));
  // 2 s (1 + z/3 + tail), the first two terms in two parts.
  const Pair square = product(s, s);
  const Pair third = product(square.high, 1.0 / 3.0);
  constexpr double kThirdLow = 1.85037170770859413e-17;  // 1/3 - fl(1/3)
  const double third_low =
      third.low + square.high * kThirdLow + (square.low + 2.0 * s * s_low) / 3.0;
  Pair series = fast_sum(1.0, third.high);
  series.low += third_low + tail;
  const Pair main = product(2.0 * s, series.high);
  const double main_low = main.low + 2.0 * s * series.low + 2.0 * s_low * series.high;
  const Pair whole = sum(k * kLn2High, main.high);
  const double low = whole.low + (main_low + k * kLn2Low);
  return fast_sum(whole.high, low);
}

/// The factor f of e^(x + low) = 2^k f, where |low| is much smaller than |x|. Real: double, or a
/// vector of them.
template <class Real>
void exp_reduced(const Real& x, const Real& low, Real& out, Real& shifted) {
  constexpr double kOneOverLn2 = 1.44269504088896338700e+00;
  shifted = x * kOneOverLn2 + kShift;
  const Real k = shifted - kShift;
  const Real high = x - k * kLn2High;
  const Real rest = k * kLn2Low - low;
  const Real r = high - rest;
  const Real z = r * r;
  const Real c =
      r - z * (1.66666666666666019037e-01 +
               z * (-2.77777777770155933842e-03 +
                    z * (6.61375632143793436117e-05 +
                         z * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08))));
  out = 1.0 - ((rest - (r * c) / (2.0 - c)) - high);
}

/// e^(x + low).
double exp_of(double x, double low) {
  double y, shifted;
  exp_reduced(x, low, y, shifted);
  const int n = static_cast<int>(shifted - kShift);
  const int half = n / 2;  // in two steps, so that 2^1024 is never needed
  return y * power_of_two(half) * power_of_two(n - half);
}

constexpr double kExpLowest = -708.0;
constexpr double kExpHighest = 709.782712893383973096;

double exp_clamped(double x, double low) {
  if (is_nan(x)) return kNaN;
  if (x > kExpHighest) return kInfinity;
  if (x < kExpLowest) return 0.0;
  return exp_of(x, low);
}

bool is_whole(double x) { return magnitude(x) >= 0x1p52 || nearest(x) == x; }

bool is_odd(double x) {
  return magnitude(x) < 0x1p53 && (static_cast<std::int64_t>(magnitude(x)) & 1) != 0;
}

}  // namespace

SinCos<double> sin_cos(double x) noexcept {
  if (!(__builtin_fabs(x) <= kLargestAngle)) return {kNaN, kNaN};
  Reduced<double> r;
  reduce(x, r);
  double s, c;
  sine(r.value, r.tail, s);
  cosine(r.value, r.tail, c);
  const auto quadrant = std::bit_cast<std::uint64_t>(r.shifted);
  const bool swap = (quadrant & 1U) != 0;
  const double sin_magnitude = swap ? c : s;
  const double cos_magnitude = swap ? s : c;
  return {(quadrant & 2U) != 0 ? -sin_magnitude : sin_magnitude,
          ((quadrant + 1U) & 2U) != 0 ? -cos_magnitude : cos_magnitude};
}

double atan2(double y, double x) noexcept {
  constexpr double kPi = 3.14159265358979311600e+00, kPiLow = 1.22464679914735317636e-16;
  if (is_nan(x) || is_nan(y)) return kNaN;
  const bool negative_y = std::bit_cast<std::int64_t>(y) < 0;
  const bool negative_x = x < 0.0;
  double a = magnitude(x), b = magnitude(y);
  if (a == kInfinity && b == kInfinity) a = b = 1.0;
  const bool steep = b > a;
  const double larger = steep ? b : a, smaller = steep ? a : b;
  // Table points 0, 1/2, 1 keep the polynomial's argument small.
  const double t = larger > 0.0 ? (larger == kInfinity ? 0.0 : smaller / larger) : 0.0;
  double base = 0.0, base_low = 0.0, u = t;
  if (t >= 0.6875) {
    base = 7.85398163397448278999e-01;
    base_low = 3.06161699786838301793e-17;
    u = (smaller - larger) / (smaller + larger);
    if (larger > 0x1p1020) u = (0.25 * smaller - 0.25 * larger) / (0.25 * smaller + 0.25 * larger);
  } else if (t >= 0.4375) {
    base = 4.63647609000806093515e-01;
    base_low = 2.26987774529616870924e-17;
    u = (2.0 * t - 1.0) / (2.0 + t);
  }
  const double first = base - ((atan_polynomial(u) - base_low) - u);
  double angle = first;
  if (steep)
    angle = negative_x ? 0.5 * kPi + (first + 0.5 * kPiLow) : 0.5 * kPi - (first - 0.5 * kPiLow);
  else if (negative_x)
    angle = kPi - (first - kPiLow);
  return negative_y ? -angle : angle;
}

double exp(double x) noexcept { return exp_clamped(x, 0.0); }

/// Results other than zero are normal numbers, and so is the power of two, which is made from k in
/// the last bits of `shifted`. Where the result is zero the power may be any number, because it is
/// not used.
Two exp_of_negative(Two x) noexcept {
  using Modular = std::uint64_t __attribute__((vector_size(sizeof(Two))));
  Two y, shifted;
  exp_reduced(x, Two{}, y, shifted);
  const Modular power =
      (reinterpret_cast<Modular>(shifted) << 52) + std::bit_cast<std::uint64_t>(1.0);
  const Two value = y * reinterpret_cast<Two>(power);
  return reinterpret_cast<Two>(reinterpret_cast<TwoBits>(value) & ~(x < kExpLowest));
}

double log(double x) noexcept {
  if (is_nan(x) || x < 0.0) return kNaN;
  if (x < std::numeric_limits<double>::min()) return -kInfinity;
  if (x == kInfinity) return kInfinity;
  return log_pair(x).high;
}

double tanh(double x) noexcept {
  if (is_nan(x)) return kNaN;
  const double a = magnitude(x);
  double t = 1.0;
  if (a < 0.625) {
    // Lambert's continued fraction, nine levels: exact to rounding here.
    const double z = a * a;
    double f = 17.0;
    for (int odd = 15; odd > 0; odd -= 2) f = odd + z / f;
    t = a / f;
  } else if (a < 22.0) {
    t = 1.0 - 2.0 / (exp_of(2.0 * a, 0.0) + 1.0);
  }
  return std::bit_cast<std::int64_t>(x) < 0 ? -t : t;
}

double pow(double x, double y) noexcept {
  if (y == 0.0) return 1.0;
  if (is_nan(x) || is_nan(y)) return kNaN;
  const double base = magnitude(x);
  if (x < 0.0 && !is_whole(y)) return kNaN;
  const double sign = x < 0.0 && is_odd(y) ? -1.0 : 1.0;
  if (base < std::numeric_limits<double>::min()) return y > 0.0 ? 0.0 : sign * kInfinity;
  if (base == kInfinity) return y > 0.0 ? sign * kInfinity : 0.0;
  if (magnitude(y) > 1e20) return base == 1.0 ? 1.0 : ((base > 1.0) == (y > 0.0) ? kInfinity : 0.0);
  const Pair l = log_pair(base);
  const Pair p = product(y, l.high);
  return sign * exp_clamped(p.high, p.low + y * l.low);
}

}  // namespace plumb::portable

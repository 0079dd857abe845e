// SPDX-License-Identifier: Apache-2.0
// Against the long double functions of the C library.
#include "plumb/runtime/detail/elementary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/random_numbers.hpp"

namespace plumb::portable {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Distance in units of the last place of a double near the exact value.
double ulps(double got, long double exact) {
  if (exact == 0.0L) return got == 0.0 ? 0.0 : kInf;
  int exponent = 0;
  (void)std::frexp(exact, &exponent);
  return static_cast<double>(std::fabs(static_cast<long double>(got) - exact) /
                             std::ldexp(1.0L, exponent - 53));
}

/// Worst error of f over `count` random arguments made by `draw`.
template <class Draw, class F, class Exact>
double worst(Draw draw, F f, Exact exact) {
  tests::Random random(kSeed);
  double out = 0.0;
  const long count = tests::scaled(1000000);
  for (long i = 0; i < count; ++i) {
    const double x = draw(random);
    out = std::max(out, ulps(f(x), exact(static_cast<long double>(x))));
  }
  std::printf("%ld cases, seed %d: worst %.3f ulp\n", count, static_cast<int>(kSeed), out);
  return out;
}

auto uniform(double size) {
  return [size](tests::Random& r) { return r.uniform(-size, size); };
}

/// Sign and size both random, sizes over many decades.
double wide(tests::Random& r) { return r.uniform(-1, 1) * std::exp(r.uniform(-40, 40)); }

TEST(SinCos, StaysBelowOneUlpInItsWholeDomain) {
  for (double size : {1e-3, 1.0, 7.0, 1e3, 1e5}) {
    EXPECT_LT(worst(
                  uniform(size), [](double x) { return sin_cos(x).sin; },
                  [](long double x) { return std::sin(x); }),
              1.0);
    EXPECT_LT(worst(
                  uniform(size), [](double x) { return sin_cos(x).cos; },
                  [](long double x) { return std::cos(x); }),
              1.0);
  }
}

TEST(SinCos, StaysBelowOneUlpRightBesideMultiplesOfHalfPi) {
  double out = 0.0;
  for (int k = -60000; k <= 60000; k += 7)
    for (int step = -2; step <= 2; ++step) {
      double x = k * M_PI_2;
      for (int i = 0; i < std::abs(step); ++i) x = std::nextafter(x, step < 0 ? -1e9 : 1e9);
      const auto t = sin_cos(x);
      out = std::max({out, ulps(t.sin, std::sin(static_cast<long double>(x))),
                      ulps(t.cos, std::cos(static_cast<long double>(x)))});
    }
  // The reference itself is exact to 2^-64 of one, so tiny results are compared absolutely too.
  EXPECT_LT(out, 1.0);
}

TEST(SinCos, OutsideItsDomainGivesNaN) {
  for (double x : {1.0001e5, -1e6, kInf, -kInf, kNaN}) {
    EXPECT_TRUE(std::isnan(sin_cos(x).sin)) << x;
    EXPECT_TRUE(std::isnan(sin_cos(x).cos)) << x;
  }
}

TEST(SinCos, StaysOnTheUnitCircle) {
  EXPECT_EQ(sin_cos(0.0).sin, 0.0);
  EXPECT_EQ(sin_cos(0.0).cos, 1.0);
  tests::Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const auto t = sin_cos(random.uniform(-1e5, 1e5));
    EXPECT_NEAR(t.sin * t.sin + t.cos * t.cos, 1.0, 4e-16);
  }
}

TEST(Atan2, StaysBelowTwoUlpInAllQuadrantsAndAtAllRatios) {
  tests::Random random(kSeed);
  double out = 0.0;
  for (long i = 0, n = tests::scaled(2000000); i < n; ++i) {
    const double y = wide(random), x = wide(random);
    out = std::max(out, ulps(portable::atan2(y, x),
                             std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  std::printf("worst %.3f ulp\n", out);
  EXPECT_LT(out, 2.0);
}

TEST(Atan2, AgreesWithTheStandardOnAxesZeroesAndInfinities) {
  for (double y : {0.0, -0.0, 1.0, -1.0, kInf, -kInf})
    for (double x : {0.0, 1.0, -1.0, kInf, -kInf})
      EXPECT_EQ(portable::atan2(y, x), std::atan2(y, x)) << y << " " << x;
  EXPECT_TRUE(std::isnan(portable::atan2(kNaN, 1.0)));
  EXPECT_TRUE(std::isnan(portable::atan2(1.0, kNaN)));
}

TEST(Exp, StaysBelowOneUlpAndNeverGivesADenormal) {
  for (double size : {1e-6, 1.0, 700.0})
    EXPECT_LT(worst(
                  uniform(size), [](double x) { return portable::exp(x); },
                  [](long double x) { return std::exp(x); }),
              1.0);
  for (double x = -700.0; x > -1000.0; x -= 0.37) {
    const double y = portable::exp(x);
    EXPECT_TRUE(y == 0.0 || std::isnormal(y)) << x;
  }
  EXPECT_EQ(portable::exp(710.0), kInf);
  EXPECT_EQ(portable::exp(-kInf), 0.0);
  EXPECT_TRUE(std::isnan(portable::exp(kNaN)));
}

TEST(Exp, OfTwoIsTheExpOfEach) {
  tests::Random random(kSeed);
  const auto draw = [&random]() -> double {
    constexpr std::array kEdges{0.0,     -0.0,   -708.0, -708.0000000000001,
                                -1e-310, -1e308, -kInf,  kNaN};
    const auto edge = static_cast<std::size_t>(random.below(16));
    return edge < kEdges.size() ? kEdges[edge] : random.uniform(-720.0, 0.0);
  };
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(std::isnan(x) ? kNaN : x); };
  for (long i = tests::scaled(1000000); i > 0; --i) {
    const Two x{draw(), draw()};
    const Two y = exp_of_negative(x);
    ASSERT_EQ(bits(y[0]), bits(exp(x[0]))) << x[0];
    ASSERT_EQ(bits(y[1]), bits(exp(x[1]))) << x[1];
  }
}

TEST(Log, StaysBelowOneUlpAlsoCloseToOne) {
  const auto positive = [](double spread) {
    return [spread](tests::Random& r) { return std::exp(r.uniform(-spread, spread)); };
  };
  for (double spread : {1e-9, 1e-3, 1.0, 700.0})
    EXPECT_LT(worst(
                  positive(spread), [](double x) { return portable::log(x); },
                  [](long double x) { return std::log(x); }),
              1.0);
  EXPECT_EQ(portable::log(1.0), 0.0);
  EXPECT_EQ(portable::log(0.0), -kInf);
  EXPECT_EQ(portable::log(kInf), kInf);
  EXPECT_TRUE(std::isnan(portable::log(-1.0)));
}

TEST(Tanh, StaysBelowTwoUlpAndNeverExceedsOne) {
  for (double size : {1e-6, 0.7, 3.0, 30.0})
    EXPECT_LT(worst(
                  uniform(size), [](double x) { return portable::tanh(x); },
                  [](long double x) { return std::tanh(x); }),
              2.0);
  for (double x : {20.0, 100.0, 1e308, kInf}) {
    EXPECT_EQ(portable::tanh(x), 1.0);
    EXPECT_EQ(portable::tanh(-x), -1.0);
  }
}

TEST(Pow, StaysBelowTwoUlp) {
  tests::Random random(kSeed);
  double out = 0.0;
  for (long i = 0, n = tests::scaled(1000000); i < n; ++i) {
    const double x = std::exp(random.uniform(-6, 6)), y = random.uniform(-100, 100);
    out = std::max(out, ulps(portable::pow(x, y),
                             std::pow(static_cast<long double>(x), static_cast<long double>(y))));
  }
  std::printf("worst %.3f ulp\n", out);
  EXPECT_LT(out, 2.0);
}

TEST(Pow, KnowsItsSpecialCases) {
  EXPECT_EQ(portable::pow(-2.0, 3.0), -8.0);
  EXPECT_EQ(portable::pow(-2.0, 2.0), 4.0);
  EXPECT_TRUE(std::isnan(portable::pow(-2.0, 0.5)));
  EXPECT_EQ(portable::pow(kNaN, 0.0), 1.0);
  EXPECT_EQ(portable::pow(0.0, 2.0), 0.0);
  EXPECT_EQ(portable::pow(0.0, -1.0), kInf);
  EXPECT_EQ(portable::pow(10.0, 400.0), kInf);
  EXPECT_EQ(portable::pow(10.0, -400.0), 0.0);
}

}  // namespace
}  // namespace plumb::portable

// SPDX-License-Identifier: Apache-2.0
#include "numbers/tails.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

namespace plumb::offline {
namespace {

TEST(Tails, TheTailOfFIsThatOfAnotherLibrary) {
  for (const double a : {1.0, 2.0, 6.0, 40.0})
    for (const double b : {1.0, 3.0, 25.0, 3000.0})
      for (const double f : {0.01, 0.5, 1.0, 3.0, 20.0}) {
        const double expected = boost::math::cdf(complement(boost::math::fisher_f(a, b), f));
        EXPECT_NEAR(ln_f_tail(f, a, b), std::log(expected), 1e-9) << a << " " << b << " " << f;
      }
}

TEST(Tails, TheLogarithmStaysFiniteWhereTheTailUnderflows) {
  const double far = ln_f_tail(1e6, 6.0, 3000.0);
  EXPECT_TRUE(std::isfinite(far));
  EXPECT_LT(far, -745.0);  // exp() of it is 0
  EXPECT_LT(ln_f_tail(1e7, 6.0, 3000.0), far);
  EXPECT_EQ(ln_f_tail(0.0, 6.0, 30.0), 0.0);
}

TEST(Tails, AnFTestIsTheRatioOfMeanSquares) {
  const FTest test = f_test(12.0, 3.0, 40.0, 20.0);
  EXPECT_DOUBLE_EQ(test.ratio, 2.0);
  EXPECT_DOUBLE_EQ(test.ln_p, ln_f_tail(2.0, 3.0, 20.0));
}

// Tables of Student's t, for example [Abramowitz & Stegun 1964, table 26.10].
TEST(Tails, QuantilesOfStudentAreThoseOfTheTables) {
  EXPECT_NEAR(student_quantile(0.975, 1.0), 12.706, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 2.0), 4.303, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 10.0), 2.228, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 30.0), 2.042, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 5.0), 2.015, 5e-4);
}

}  // namespace
}  // namespace plumb::offline

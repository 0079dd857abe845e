// SPDX-License-Identifier: Apache-2.0
#include "numbers/products.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "numbers/product_tiles.hpp"
#include "tests/random_numbers.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline {
namespace {

struct Factors {
  Eigen::MatrixXd A, B;
};

/// Of any shape: fewer rows than are added at once, several blocks of rows, tiles that are not
/// full.
Factors random_factors(std::mt19937_64& random) {
  const auto up_to = [&](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
  std::normal_distribution<double> normal;
  const int rows = up_to(3) == 0 ? up_to(7) : up_to(700);
  Factors out{Eigen::MatrixXd(rows, up_to(9)), Eigen::MatrixXd(rows, up_to(9))};
  for (Eigen::MatrixXd* M : {&out.A, &out.B})
    for (double& x : M->reshaped()) x = normal(random);
  return out;
}

long double oracle(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::Index i,
                   Eigen::Index k) {
  long double sum = 0.0L;
  for (Eigen::Index row = 0; row < A.rows(); ++row)
    sum += static_cast<long double>(A(row, i)) * static_cast<long double>(B(row, k));
  return sum;
}

Eigen::MatrixXd by(AddProduct add, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(A.cols(), B.cols());
  add({A.data(), A.outerStride(), A.cols()}, {B.data(), B.outerStride(), B.cols()}, A.rows(),
      out.data());
  return out;
}

TEST(Products, AreTheSumsOverTheRows) {
  std::mt19937_64 random(1);
  for (long i = 0; i < tests::scaled(300); ++i) {
    const auto [A, B] = random_factors(random);
    const Eigen::MatrixXd all = transposed_product(A, B);
    ASSERT_EQ(all.rows(), A.cols());
    ASSERT_EQ(all.cols(), B.cols());
    for (Eigen::Index c = 0; c < all.cols(); ++c)
      for (Eigen::Index r = 0; r < all.rows(); ++r)
        ASSERT_NEAR(all(r, c), static_cast<double>(oracle(A, B, r, c)), 1e-12);
  }
}

TEST(Products, OfColumnsWithThemselvesAreSymmetricAndTheSameSums) {
  std::mt19937_64 random(2);
  for (long i = 0; i < tests::scaled(300); ++i) {
    const Eigen::MatrixXd A = random_factors(random).A;
    const Eigen::VectorXd weight = Eigen::VectorXd::LinSpaced(A.rows(), 0.5, 2.0);
    const Eigen::MatrixXd weighed = weight.asDiagonal() * A;
    ASSERT_EQ(gram_matrix(A), transposed_product(A, A));
    const Eigen::MatrixXd half = symmetric_product(A, weighed);
    ASSERT_EQ(half, half.transpose());
    ASSERT_TRUE(half.isApprox(transposed_product(A, weighed), 1e-13) || A.size() == 0);
  }
}

TEST(Products, OfSomeRowsReadNoOthers) {
  std::mt19937_64 random(3);
  Eigen::MatrixXd A = Eigen::MatrixXd::Constant(40, 5, NAN);
  A.middleRows(3, 30).setOnes();
  EXPECT_EQ(gram_matrix(A.middleRows(3, 30)), Eigen::MatrixXd::Constant(5, 5, 30.0));
}

#ifdef __x86_64__
TEST(Products, HaveTheSameBitsOnEveryProcessor) {
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "no AVX2";
  std::mt19937_64 random(4);
  for (long i = 0; i < tests::scaled(300); ++i) {
    const auto [A, B] = random_factors(random);
    ASSERT_EQ(by(kProductsOfAnyMachine.whole, A, B), by(kProductsOfAvx2.whole, A, B));
    const Eigen::MatrixXd any = by(kProductsOfAnyMachine.lower_half, A, A),
                          wide = by(kProductsOfAvx2.lower_half, A, A);
    ASSERT_EQ(Eigen::MatrixXd(any.triangularView<Eigen::Lower>()),
              Eigen::MatrixXd(wide.triangularView<Eigen::Lower>()));
  }
}
#endif

/// Least processor time of several turns [s].
template <class Work>
double least_time(const Work& work) {
  double least = 1e9;
  for (int turn = 0; turn < 7; ++turn) {
    const double begin = tests::processor_s();
    work();
    least = std::min(least, tests::processor_s() - begin);
  }
  return least;
}

// Measured: 0.5 of the whole product, which takes 0.4 of Eigen's time with AVX2 and 0.6 without.
TEST(Products, TakeLessTimeThanEigensAndSymmetricOnesLessAgain) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(5000, 120);
  Eigen::MatrixXd out;
  const double eigen = least_time([&] { out.noalias() = A.transpose() * A; });
  const double whole = least_time([&] { out = transposed_product(A, A); });
  const double half = least_time([&] { out = gram_matrix(A); });
  EXPECT_LT(whole, 0.85 * eigen);
  EXPECT_LT(half, 0.75 * whole);
}

}  // namespace
}  // namespace plumb::offline

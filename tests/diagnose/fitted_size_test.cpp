// SPDX-License-Identifier: Apache-2.0
// Sizes from products, against plain least squares over the rows.
#include "diagnose/fitted_size.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr Eigen::Index kRows = 40, kColumns = 3;

/// Columns X and a residual y = X theta + noise, in two folds; a model of one column, to which y is
/// orthogonal.
struct FittedSizes : testing::Test {
  FittedSizes() {
    tests::Random random(3);
    for (double& x : X.reshaped()) x = random.uniform(-1.0, 1.0);
    u = Eigen::VectorXd::Ones(kRows).normalized();
    y = X * Eigen::Vector3d(2.0, -1.0, 0.5);
    for (double& line : y) line += random.uniform(-0.3, 0.3);
    y -= u * u.dot(y);
    Z = X - u * (u.transpose() * X);
    scored = scored_of(X);
  }
  RegressorScore scored_of(const Eigen::MatrixXd& columns) const {
    RegressorScore out;
    for (const Eigen::Index begin : {Eigen::Index{0}, kRows / 2}) {
      const Eigen::MatrixXd some = columns.middleRows(begin, kRows / 2);
      out.folds.push_back({some.transpose() * some, u.segment(begin, kRows / 2).transpose() * some,
                           some.transpose() * y.segment(begin, kRows / 2)});
    }
    out.theta = Eigen::VectorXd::Zero(columns.cols());
    for (Eigen::Index c = 0; c < columns.cols(); ++c) out.active.push_back(c);
    out.variance = 0.04;
    return out;
  }
  static Eigen::VectorXd all(double sigma) { return Eigen::VectorXd::Constant(kColumns, sigma); }

  Eigen::MatrixXd X{kRows, kColumns}, Z;
  Eigen::VectorXd u, y;
  RegressorScore scored;
};

TEST_F(FittedSizes, WithoutAPriorTheyAreThoseOfLeastSquares) {
  const FittedSize found = fitted_size(scored, all(0.0));
  const Eigen::VectorXd plain = Z.colPivHouseholderQr().solve(y);
  const Eigen::MatrixXd C = scored.variance * (Z.transpose() * Z).inverse();
  EXPECT_LT((found.theta - plain).norm(), 1e-9);
  EXPECT_LT((found.std - C.diagonal().cwiseSqrt()).norm(), 1e-9);
}

TEST_F(FittedSizes, UnderANormalPriorTheyAreThoseOfRidgeRegression) {
  const double sigma = 0.1;
  const FittedSize found = fitted_size(scored, all(sigma), PriorTail::kNormal);
  Eigen::MatrixXd rows(kRows + kColumns, kColumns);
  rows << Z, std::sqrt(scored.variance) / sigma * Eigen::Matrix3d::Identity();
  Eigen::VectorXd right(kRows + kColumns);
  right << y, Eigen::Vector3d::Zero();
  EXPECT_LT((found.theta - rows.colPivHouseholderQr().solve(right)).norm(), 1e-9);
}

/// Beyond one sigma the prior pulls with constant force, and so less than a normal one.
TEST_F(FittedSizes, AHeavyTailShrinksLargeSizesLess) {
  const FittedSize heavy = fitted_size(scored, all(0.05));
  const FittedSize normal = fitted_size(scored, all(0.05), PriorTail::kNormal);
  const FittedSize plain = fitted_size(scored, all(0.0));
  EXPECT_GT(heavy.theta.norm(), normal.theta.norm() + 0.1);
  EXPECT_LT(heavy.theta.norm(), plain.theta.norm());
  const FittedSize wide = fitted_size(scored, all(1e4)), narrow = fitted_size(scored, all(1e-6));
  EXPECT_LT((wide.theta - plain.theta).norm(), 1e-6);
  EXPECT_LT(narrow.std.norm(), plain.std.norm());
}

TEST_F(FittedSizes, DoNotDependOnTheUnitOfAColumn) {
  const double unit = 250.0;
  const FittedSize here = fitted_size(scored, all(0.3));
  const FittedSize there = fitted_size(scored_of(X * unit), all(0.3 / unit));
  EXPECT_LT((there.theta * unit - here.theta).norm(), 1e-6);
  EXPECT_LT((there.std * unit - here.std).norm(), 1e-6);
}

TEST_F(FittedSizes, AColumnHeldByItsSignHasNone) {
  scored.active = {0, 2};
  const FittedSize found = fitted_size(scored, all(0.0));
  EXPECT_EQ(found.theta(1), 0.0);
  EXPECT_EQ(found.std(1), 0.0);
  const Eigen::MatrixXd others = Z(Eigen::all, std::vector<Eigen::Index>{0, 2});
  const Eigen::VectorXd plain = others.colPivHouseholderQr().solve(y);
  EXPECT_NEAR(found.theta(0), plain(0), 1e-9);
  EXPECT_NEAR(found.theta(2), plain(1), 1e-9);
}

TEST_F(FittedSizes, OfColumnsThatRepeatEachOtherAreFiniteAndAddUp) {
  Eigen::MatrixXd twice(kRows, 2);
  twice << X.col(0), X.col(0);
  const FittedSize one = fitted_size(scored_of(X.leftCols(1)), Eigen::VectorXd::Zero(1));
  const FittedSize two = fitted_size(scored_of(twice), Eigen::VectorXd::Zero(2));
  EXPECT_NEAR(two.theta.sum(), one.theta(0), 1e-3);
  EXPECT_TRUE(two.std.allFinite());
}

TEST_F(FittedSizes, WithoutDataAreNone) {
  for (const bool folds : {false, true}) {
    RegressorScore none = scored;
    if (folds)
      none.folds.clear();
    else
      none.active.clear();
    const FittedSize found = fitted_size(none, all(1.0));
    EXPECT_TRUE(found.theta.isZero(0.0));
    EXPECT_TRUE(found.std.isZero(0.0));
  }
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "numbers/cholesky.hpp"
#include "numbers/lu.hpp"
#include "numbers/pivoted_qr.hpp"
#include "numbers/spectrum.hpp"
#include "numbers/triangle.hpp"

namespace plumb::offline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Numbers without a pattern, always the same ones.
MatrixXd some(Eigen::Index rows, Eigen::Index columns) {
  MatrixXd out(rows, columns);
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out(i) = std::sin(12.9898 * static_cast<double>(i + 1)) + (i % 7 == 0 ? 1.0 : 0.0);
  return out;
}

const MatrixXd kTall = some(40, 5);
const MatrixXd kSquare = kTall.transpose() * kTall;

TEST(Factors, CholeskySolvesWhitensAndMeasures) {
  const Cholesky factor(kSquare);
  ASSERT_TRUE(factor.exists());
  const VectorXd b = some(5, 1);
  EXPECT_LT((kSquare * factor.solve(b) - b).norm(), 1e-10);
  EXPECT_LT((kSquare * factor.solve(kSquare) - kSquare).norm(), 1e-9);
  EXPECT_LT((factor.lower() * factor.lower().transpose() - kSquare).norm(), 1e-10);
  EXPECT_LT((factor.lower() * factor.whitened(b) - b).norm(), 1e-10);
  const MatrixXd Q = factor.orthonormal(kTall);
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(5, 5)).norm(), 1e-10);
  EXPECT_NEAR(factor.ln_det(), std::log(determinant(kSquare)), 1e-10);
  EXPECT_FALSE(Cholesky(-kSquare).exists());
}

/// Independent columns, however many, always the same ones.
MatrixXd independent(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

// Of many columns a part is inverted at once; 131 is no multiple of such a part.
TEST(Factors, TheInverseHasThatDiagonal) {
  const MatrixXd tall = independent(300, 131);
  const MatrixXd A = tall.transpose() * tall;
  const VectorXd exact = inverse(A).diagonal();
  const Cholesky factor(A);
  EXPECT_LT((factor.inverse_diagonal(131) - exact).norm(), 1e-12 * exact.norm());
  EXPECT_LT((factor.inverse_diagonal(50) - exact.tail(50)).norm(), 1e-12 * exact.norm());
  EXPECT_EQ(factor.inverse_diagonal(0).size(), 0);
}

TEST(Factors, ASymmetricMatrixMayBeIndefinite) {
  MatrixXd A = kSquare;
  A(2, 2) -= 100.0;
  const VectorXd b = some(5, 1);
  EXPECT_LT((A * SymmetricSolver(A).solve(b) - b).norm(), 1e-9);
  EXPECT_LT((A * SymmetricSolver(A).inverse() - MatrixXd::Identity(5, 5)).norm(), 1e-9);
}

TEST(Factors, ATriangleKeepsTheProductsOfColumns) {
  const MatrixXd R = householder_triangle(kTall);
  EXPECT_LT((R.transpose() * R - kSquare).norm(), 1e-10);
  EXPECT_LT(MatrixXd(R.triangularView<Eigen::StrictlyLower>()).norm(), 1e-300);
  EXPECT_EQ(householder_triangle(kTall.transpose()).rows(), 5);
  EXPECT_LT((R * upper_solved(R, kSquare) - kSquare).norm(), 1e-10);
  EXPECT_LT((R.transpose() * upper_transposed_solved(R, kSquare) - kSquare).norm(), 1e-10);
  EXPECT_LT((divided_by_upper(kTall, R) * R - kTall).norm(), 1e-10);
  EXPECT_NEAR(per_norm(kTall)(3) * kTall.col(3).norm(), 1.0, 1e-14);
}

TEST(Factors, PivotedQrCountsIndependentColumns) {
  MatrixXd A(40, 6);
  A << kTall, kTall.col(0) - 2.0 * kTall.col(3);
  const PivotedQr qr(A, 1e-9);
  EXPECT_EQ(qr.rank(), 5);
  const MatrixXd Q = qr.basis(5);
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(5, 5)).norm(), 1e-12);
  EXPECT_LT((A - Q * (Q.transpose() * A)).norm(), 1e-10);
  EXPECT_LT((qr.ordered(A).leftCols(5) - Q * qr.triangle(5)).norm(), 1e-10);
  EXPECT_LT((qr.ordered(MatrixXd::Identity(6, 6)) * qr.in_place(MatrixXd::Identity(6, 6)) -
             qr.ordered(qr.in_place(MatrixXd::Identity(6, 6))))
                .norm(),
            1e-14);
  const VectorXd x = some(5, 1);
  EXPECT_LT((PivotedQr(kTall).solve(kTall * x) - x).norm(), 1e-10);
  EXPECT_LT(
      (householder_basis(kTall, 5) * (householder_basis(kTall, 5).transpose() * kTall) - kTall)
          .norm(),
      1e-10);
}

TEST(Factors, SpectraAgreeWithEachOther) {
  const SymmetricEigen eigen = symmetric_eigen(kSquare);
  EXPECT_LT((kSquare * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-9);
  const VectorXd s = jacobi_singular_values(kTall);
  EXPECT_LT((s.reverse().cwiseAbs2() - eigen.values).norm(), 1e-9);
  const RightSingular right = right_singular(kTall);
  EXPECT_LT(((kTall * right.vectors).colwise().norm().transpose() - right.values).norm(), 1e-10);
  EXPECT_NEAR(largest_generalised_eigenvalue(2.5 * kSquare, kSquare), 2.5, 1e-10);
}

TEST(Factors, ASingularMatrixHasNoSolution) {
  MatrixXd A = kSquare;
  A.row(1) = A.row(0);
  EXPECT_FALSE(solved_if_regular(A, some(5, 1)));
  const auto x = solved_if_regular(kSquare, some(5, 1));
  ASSERT_TRUE(x);
  EXPECT_LT((kSquare * *x - some(5, 1)).norm(), 1e-9);
  EXPECT_LT((inverse(kSquare) * kSquare - MatrixXd::Identity(5, 5)).norm(), 1e-9);
}

}  // namespace
}  // namespace plumb::offline

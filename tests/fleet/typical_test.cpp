// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "fleet/odd_arms.hpp"

namespace {

using plumb::offline::fleet::CellSummary;
using plumb::offline::fleet::learn_sisters;
using plumb::offline::fleet::learn_typical;

/// Arms whose true numbers are drawn around a mean, and fits of them with correlated errors.
class Arms {
 public:
  explicit Arms(unsigned seed) : random_(seed) {}

  CellSummary arm(const Eigen::VectorXd& mean, const Eigen::VectorXd& sd, double fit_sd) {
    const auto n = mean.size();
    Eigen::MatrixXd C(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index k = 0; k < n; ++k) C(i, k) = fit_sd * fit_sd * (i == k ? 1.0 : 0.6);
    const Eigen::MatrixXd L = C.llt().matrixL();
    Eigen::VectorXd truth(n), noise(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      truth(i) = mean(i) + sd(i) * normal_(random_);
      noise(i) = normal_(random_);
    }
    const Eigen::VectorXd x = truth + L * noise;
    CellSummary out;
    out.name = "cell" + std::to_string(++count_);
    out.ok = true;
    out.covariance = C;
    for (Eigen::Index i = 0; i < n; ++i)
      out.numbers.push_back({.name = "n" + std::to_string(i),
                             .effect = "geometry",
                             .unit = "m",
                             .value = x(i),
                             .std = fit_sd});
    truth_.push_back(truth);
    return out;
  }
  const std::vector<Eigen::VectorXd>& truth() const { return truth_; }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::VectorXd> truth_;
  int count_ = 0;
};

std::vector<const CellSummary*> pointers(const std::vector<CellSummary>& arms) {
  std::vector<const CellSummary*> out;
  for (const auto& arm : arms) out.push_back(&arm);
  return out;
}

const Eigen::Vector3d kMean(0.2e-3, 0.0, -0.4e-3), kSd(0.3e-3, 0.05e-3, 0.1e-3);

TEST(Typical, FindsMeanAndSpreadThatTheFitsBlur) {
  Arms arms(1);
  std::vector<CellSummary> all;
  for (int i = 0; i < 400; ++i) all.push_back(arms.arm(kMean, kSd, 0.1e-3));
  const auto typical = learn_typical(pointers(all));
  ASSERT_EQ(typical.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(typical[k].mean, kMean(k), 4.0 * std::hypot(kSd(k), 0.1e-3) / 20.0);
    EXPECT_NEAR(typical[k].sd, kSd(k), 0.25 * kSd(k));
    EXPECT_EQ(typical[k].arms, 400);
  }
  EXPECT_LT(typical[0].shrinkage, 0.2) << "arms differ by more than a fit errs";
  EXPECT_GT(typical[1].shrinkage, 0.5) << "a fit errs by more than arms differ";
}

TEST(Typical, FewerThanFiveArmsTeachNothing) {
  Arms arms(2);
  std::vector<CellSummary> all;
  for (int i = 0; i < 4; ++i) all.push_back(arms.arm(kMean, kSd, 0.1e-3));
  EXPECT_TRUE(learn_typical(pointers(all)).empty());
  all.push_back(arms.arm(kMean, kSd, 0.1e-3));
  EXPECT_EQ(learn_typical(pointers(all)).size(), 3U);
}

TEST(Typical, ANumberThatAFitHeldAtNominalSaysNothing) {
  Arms arms(3);
  std::vector<CellSummary> all;
  for (int i = 0; i < 40; ++i) {
    all.push_back(arms.arm(kMean, kSd, 0.02e-3));
    if (i % 2 == 0) continue;
    all.back().numbers.erase(all.back().numbers.begin());
    all.back().covariance = all.back().covariance.bottomRightCorner(2, 2).eval();
  }
  const auto typical = learn_typical(pointers(all));
  const auto first =
      std::find_if(typical.begin(), typical.end(), [](const auto& t) { return t.name == "n0"; });
  ASSERT_NE(first, typical.end());
  EXPECT_EQ(first->arms, 20);
  EXPECT_NEAR(first->mean, kMean(0), 3.5 * kSd(0) / std::sqrt(20.0));
}

TEST(Sisters, AnArmThatIsUnlikeThemIsFoundAndTeachesNothing) {
  Arms arms(4);
  std::vector<CellSummary> all;
  for (int i = 0; i < 30; ++i) all.push_back(arms.arm(kMean, kSd, 0.05e-3));
  all[17].numbers[1].value += 1e-3;
  const auto sisters = learn_sisters(pointers(all));
  ASSERT_EQ(sisters.odd.size(), 1U);
  EXPECT_EQ(sisters.odd[0].cell, all[17].name);
  EXPECT_EQ(sisters.odd[0].number, "n1");
  EXPECT_EQ(sisters.typical[1].arms, 29);
}

TEST(Sisters, AmongArmsThatAreAlikeNoneIsCalledOdd) {
  int odd = 0;
  for (unsigned seed = 10; seed < 110; ++seed) {
    Arms arms(seed);
    std::vector<CellSummary> all;
    for (int i = 0; i < 12; ++i) all.push_back(arms.arm(kMean, kSd, 0.05e-3));
    odd += learn_sisters(pointers(all)).odd.empty() ? 0 : 1;
  }
  EXPECT_LE(odd, 4) << "of 100 fleets; 1 is stated";
}

}  // namespace

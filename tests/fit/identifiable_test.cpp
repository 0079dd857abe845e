// SPDX-License-Identifier: Apache-2.0
#include "solve/identifiable.hpp"

#include <gtest/gtest.h>

namespace plumb::offline {
namespace {

Eigen::MatrixXd with_copies() {
  std::srand(7);
  Eigen::MatrixXd J = Eigen::MatrixXd::Random(50, 6);
  J.col(3) = 2.0 * J.col(0) - J.col(1);
  J.col(5).setZero();
  return J;
}

TEST(Identifiable, KeepsTheEarlierOfDependentColumnsAndDropsColumnsOfZeros) {
  const ColumnSubset subset = identifiable(with_copies(), {});
  EXPECT_EQ(subset.kept, (std::vector<int>{0, 1, 2, 4}));
  EXPECT_EQ(subset.dropped, (std::vector<int>{3, 5}));
}

TEST(Identifiable, ScalingTheDataDoesNotChangeTheRank) {
  for (double scale : {1e-12, 1e-3, 1e9})
    EXPECT_EQ(identifiable(with_copies() * scale, {}).kept.size(), 4u) << scale;
}

TEST(Identifiable, ANumberWithTooLargeAStandardDeviationIsHeld) {
  Eigen::MatrixXd J = with_copies();
  J.col(4) = J.col(0) + 1e-3 * J.col(4);
  EXPECT_EQ(identifiable(J, {.max_std = 1e6}).kept.size(), 4u);
  EXPECT_EQ(identifiable(J, {.max_std = 1.0}).kept, (std::vector<int>{0, 1, 2}));
}

TEST(Identifiable, FewerRowsThanColumnsKeepAtMostAsManyAsRows) {
  const Eigen::MatrixXd J = Eigen::MatrixXd::Random(3, 8);
  EXPECT_LE(identifiable(J, {}).kept.size(), 3u);
}

}  // namespace
}  // namespace plumb::offline

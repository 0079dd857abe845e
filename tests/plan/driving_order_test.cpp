// SPDX-License-Identifier: Apache-2.0
#include "plan/driving_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

TEST(DrivingOrder, VisitsEveryPoseOnceAndIsNearTheShortestOfAllOrders) {
  const int count = static_cast<int>(tests::scaled(50));
  std::printf("[ count    ] %d, seed 1\n", count);
  tests::Random random(1);
  const Eigen::VectorXd range = Eigen::Vector3d(2.0, 1.0, 4.0), start = Eigen::Vector3d::Zero();
  double ratio = 0.0;
  for (int k = 0; k < count; ++k) {
    RowsN q(7, 3);
    for (double& v : q.reshaped()) v = random.uniform(-1.0, 1.0);
    std::vector<int> order(7);
    std::iota(order.begin(), order.end(), 0);
    double shortest = 1e300;
    do shortest = std::min(shortest, driving_length(q, order, range, start));
    while (std::next_permutation(order.begin(), order.end()));
    auto found = driving_order(q, range, start);
    const double length = driving_length(q, found, range, start);
    ratio += length / shortest / count;
    EXPECT_GE(length, shortest - 1e-12);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, order = std::vector<int>({0, 1, 2, 3, 4, 5, 6}));
  }
  std::printf("[ ratio    ] %.3f of the shortest\n", ratio);
  EXPECT_LT(ratio, 1.05);
}

TEST(DrivingOrder, MeasuresAMoveByTheJointThatNeedsMostOfItsRange) {
  RowsN q(2, 2);
  q << 1.0, 0.0, 0.0, 1.0;
  const Eigen::VectorXd range = Eigen::Vector2d(10.0, 2.0), start = Eigen::Vector2d::Zero();
  EXPECT_DOUBLE_EQ(driving_length(q, {0, 1}, range, start), 0.1 + 0.5);
}

}  // namespace
}  // namespace plumb::offline

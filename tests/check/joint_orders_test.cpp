// SPDX-License-Identifier: Apache-2.0
#include "check/joint_orders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace plumb::offline {
namespace {

using Order = std::vector<int>;

/// Joints 1, 2, 4, 5, ...: between them is one that slides.
Order turning_joints(int count) {
  Order out;
  for (int j = 1; static_cast<int>(out.size()) < count; ++j)
    if (j != 3) out.push_back(j);
  return out;
}

std::set<Order> as_set(const std::vector<Order>& orders) { return {orders.begin(), orders.end()}; }

/// Whether a slip of a single hand makes `order` of `joints`: two swapped, or neighbours that are
/// moved on by one place or reversed.
bool is_one_slip(const Order& joints, const Order& order) {
  std::size_t from = 0, to = joints.size() - 1;
  while (from < joints.size() && order[from] == joints[from]) ++from;
  if (from == joints.size()) return false;
  while (order[to] == joints[to]) --to;
  int moved = 0;
  bool is_up = true, is_down = true, is_reversed = true;
  for (std::size_t i = from; i <= to; ++i) {
    moved += order[i] != joints[i] ? 1 : 0;
    is_up = is_up && order[i] == joints[i == to ? from : i + 1];
    is_down = is_down && order[i] == joints[i == from ? to : i - 1];
    is_reversed = is_reversed && order[i] == joints[from + to - i];
  }
  return moved == 2 || is_up || is_down || is_reversed;
}

TEST(JointOrders, OfUpToSixJointsAreAllOthersEachOnce) {
  long factorial = 1;
  for (int count = 1; count <= 6; ++count) {
    factorial *= count;
    const Order joints = turning_joints(count);
    const auto orders = joint_orders(joints);
    EXPECT_EQ(static_cast<long>(orders.size()), factorial - 1) << count;
    EXPECT_EQ(as_set(orders).size(), orders.size()) << count;
    for (const Order& order : orders) {
      EXPECT_NE(order, joints);
      EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), joints.begin(), joints.end()));
    }
  }
  EXPECT_TRUE(joint_orders({}).empty());
}

TEST(JointOrders, OfMoreJointsAreThoseThatOneSlipMakesOfThem) {
  for (const int count : {7, 8}) {
    const Order joints = turning_joints(count);
    std::set<Order> expected;
    Order order = joints;
    while (std::next_permutation(order.begin(), order.end()))
      if (is_one_slip(joints, order)) expected.insert(order);
    EXPECT_GT(expected.size(), 50U);
    EXPECT_EQ(as_set(joint_orders(joints)), expected) << count;
  }
}

TEST(JointOrders, OfMoreJointsAreEachTriedOnce) {
  const auto orders = joint_orders(turning_joints(7));
  EXPECT_EQ(as_set(orders).size(), orders.size());
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "check/coupling_guess.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>

#include "tests/random_numbers.hpp"
#include "tests/runtime/random_arm.hpp"

namespace plumb::offline {
namespace {

const format::Chain kArms[] = {test::ur10(), test::scara(), test::iiwa(), test::planar(2)};

bool among(const std::vector<Couplings>& all, const Couplings& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

Eigen::MatrixXd matrix_of(const Couplings& couplings, std::size_t joints) {
  const auto n = static_cast<Eigen::Index>(joints);
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(n, n);
  for (const auto& one : couplings) out(one.joint, one.by) += one.ratio;
  return out;
}

TEST(CouplingGuess, OnlyJointsThatTurnAreCoupledAndNoneByItself) {
  for (const auto& arm : kArms)
    for (const auto& couplings : plausible_couplings(arm))
      for (const auto& one : couplings) {
        EXPECT_NE(one.joint, one.by);
        EXPECT_EQ(arm.joints[one.joint].type, format::JointType::kRevolute);
        EXPECT_EQ(arm.joints[one.by].type, format::JointType::kRevolute);
      }
}

TEST(CouplingGuess, NoneIsGuessedTwiceAndThoseOfNeighboursAreAmongThem) {
  for (const auto& arm : kArms) {
    const auto all = plausible_couplings(arm);
    for (std::size_t a = 0; a < all.size(); ++a)
      EXPECT_EQ(std::count(all.begin(), all.end(), all[a]), 1) << a;
    EXPECT_FALSE(neighbour_couplings(arm).empty());
    for (const auto& one : neighbour_couplings(arm)) EXPECT_TRUE(among(all, one));
  }
}

/// Couplings in controllers' angles are the same where joints count the other way: (I + K) becomes
/// S (I + K) S, and that is a plausible one again.
TEST(CouplingGuess, JointsThatCountTheOtherWayHaveTheSameGuesses) {
  tests::Random random(6);
  for (const auto& arm : kArms) {
    const std::size_t joints = arm.joints.size();
    std::vector<bool> reversed;
    Eigen::VectorXd S(static_cast<Eigen::Index>(joints));
    for (double& sign : S) {
      reversed.push_back(random.below(2) == 1);
      sign = reversed.back() ? -1.0 : 1.0;
    }
    const auto all = plausible_couplings(arm);
    for (const auto& one : all) {
      const Couplings other = reversed_couplings(one, reversed);
      EXPECT_EQ(matrix_of(other, joints), S.asDiagonal() * matrix_of(one, joints) * S.asDiagonal());
      EXPECT_TRUE(among(all, other));
      EXPECT_EQ(reversed_couplings(other, reversed), one);
    }
  }
}

}  // namespace
}  // namespace plumb::offline

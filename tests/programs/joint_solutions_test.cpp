// SPDX-License-Identifier: Apache-2.0
#include "programs/joint_solutions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "tests/random_numbers.hpp"

namespace plumb::offline::programs {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

/// The heavy arm of the demo: modified rows of Denavit and Hartenberg, wrist axes that meet.
format::Chain heavy_arm() {
  format::Chain arm;
  arm.convention = format::Convention::kModified;
  const double rows[6][4] = {{0, 0, 0.642, 0}, {-90, 0.25, 0.45, -90}, {0, 0.95, -0.45, 90},
                             {90, 0, 0.8, 0},  {-90, 0, 0, 0},         {90, 0, 0.194, 0}};
  const double limit[6] = {180, 115, 140, 180, 120, 180};
  for (int i = 0; i < 6; ++i) {
    format::JointRow row;
    row.name = "J" + std::to_string(i + 1);
    row.alpha = rows[i][0] * kDeg;
    row.a = rows[i][1];
    row.d = rows[i][2];
    row.theta = rows[i][3] * kDeg;
    row.q_min = -limit[i] * kDeg;
    row.q_max = limit[i] * kDeg;
    arm.joints.push_back(row);
  }
  arm.tool.p = {0, 0, 0.15};
  return arm;
}

/// Wrist in front of axis 1 and of the lower arm, in the vertical plane of the arm: lengths and
/// angles only, as one would draw it.
std::pair<bool, bool> drawn(const Joints& q) {
  const double upper = q[1], fore = q[1] + q[2];  // from the vertical, positive forwards
  const double elbow_x = 0.25 + 0.95 * std::sin(upper), elbow_z = 0.95 * std::cos(upper);
  const double wrist_x = elbow_x + 0.8 * std::sin(fore), wrist_z = elbow_z + 0.8 * std::cos(fore);
  const double ux = elbow_x - 0.25, uz = elbow_z, wx = wrist_x - 0.25, wz = wrist_z;
  return {wrist_x > 0.0, uz * wx - ux * wz > 0.0};
}

/// As a RAPID target states it: quarter turns, the side of axis 5, wrist and elbow.
Configuration configuration_of(const Joints& q) {
  const auto [front, elbow] = drawn(q);
  Configuration out{.ranges = {}, .front = front, .elbow_front = elbow};
  for (const int axis : {0, 3, 5}) {
    const double quarter = std::floor(q[static_cast<std::size_t>(axis)] / (90.0 * kDeg));
    out.ranges.push_back({axis, 90.0 * quarter, 90.0 * (quarter + 1.0)});
  }
  out.ranges.push_back({4, q[4] < 0.0 ? -360.0 : 0.0, q[4] < 0.0 ? 0.0 : 360.0});
  return out;
}

Joints random_joints(std::mt19937_64& random, const format::Chain& arm) {
  Joints q;
  for (const auto& joint : arm.joints)
    q.push_back(std::uniform_real_distribution<double>(joint.q_min, joint.q_max)(random));
  return q;
}

TEST(JointSolutions, TheConfigurationOfATargetSaysWhichOneIsMeant) {
  const format::Chain arm = heavy_arm();
  const JointSolutions solutions(arm);
  const Chain chain(arm);
  std::mt19937_64 random(11);
  const long count = tests::scaled(100);
  long found = 0, wrong = 0, used = 0;
  for (long k = 0; k < count; ++k) {
    const Joints q = random_joints(random, arm);
    if (std::abs(q[4]) < 0.05) continue;
    ++used;
    const Configuration said = configuration_of(q);
    EXPECT_TRUE(solutions.agrees(said, q));
    const auto answer = solutions.find(chain.forward(q), said, {});
    if (answer.q.empty()) continue;
    double far = 0.0;
    for (std::size_t i = 0; i < 6; ++i) far = std::max(far, std::abs(answer.q[i] - q[i]));
    ++(far < 1e-6 ? found : wrong);
  }
  std::printf("%ld poses, seed 11: %ld found, %ld not decided\n", used, found,
              used - found - wrong);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(found, used * 9 / 10);
}

/// Where the arm was before makes the search short and never changes what is found.
TEST(JointSolutions, TheConfigurationDecidesWhereverTheArmWasBefore) {
  const format::Chain arm = heavy_arm();
  const JointSolutions solutions(arm);
  const Chain chain(arm);
  std::mt19937_64 random(13);
  int found = 0;
  for (int k = 0; k < 60; ++k) {
    const Joints q = random_joints(random, arm), elsewhere = random_joints(random, arm);
    if (std::abs(q[4]) < 0.05) continue;
    const Configuration said = configuration_of(q);
    const auto alone = solutions.find(chain.forward(q), said, {});
    Joints beside = q;
    for (double& value : beside) value += 0.1;
    for (const Joints& last : {elsewhere, beside}) {
      const auto after = solutions.find(chain.forward(q), said, last);
      if (alone.q.empty() || after.q.empty()) continue;
      ++found;
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(after.q[i], alone.q[i], 1e-6) << k;
    }
  }
  EXPECT_GT(found, 80);
}

TEST(JointSolutions, WithoutAConfigurationTheNearestOneIsTakenAndWithoutAnyNone) {
  const format::Chain arm = heavy_arm();
  const JointSolutions solutions(arm);
  const Chain chain(arm);
  std::mt19937_64 random(12);
  int undecided = 0;
  for (int k = 0; k < 30; ++k) {
    Joints q = random_joints(random, arm);
    if (std::abs(q[4]) < 0.2) q[4] = 0.5;
    Joints last = q;
    for (double& value : last) value += 0.02;
    const auto near = solutions.find(chain.forward(q), {}, last);
    ASSERT_EQ(near.q.size(), 6U) << near.why;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(near.q[i], q[i], 1e-6);
    undecided += solutions.find(chain.forward(q), {}, {}).q.empty() ? 1 : 0;
  }
  EXPECT_EQ(undecided, 30) << "the wrist alone always has two ways";
}

TEST(JointSolutions, WhatIsNearestButFarIsNotTaken) {
  const format::Chain arm = heavy_arm();
  const JointSolutions solutions(arm);
  const Joints q{0.1, 0.2, 0.9, 0.3, 0.7, 0.4};
  for (const double turn_deg : {50.0, 70.0}) {
    Joints last = q;
    last[0] += turn_deg * kDeg;
    const auto answer = solutions.find(Chain(arm).forward(q), {}, last);
    EXPECT_EQ(answer.q.empty(), turn_deg > 60.0);
    if (turn_deg > 60.0)
      EXPECT_NE(answer.why.find("none is near"), std::string::npos) << answer.why;
    else
      EXPECT_NEAR(answer.q.at(0), q[0], 1e-6);
  }
}

/// The program states the elbow, and behind axis 1 it is not read: the nearest may be the other
/// one.
TEST(JointSolutions, BehindAxis1WhereTheElbowIsNotReadSeveralAreNoAnswer) {
  const format::Chain arm = heavy_arm();
  const JointSolutions solutions(arm);
  const Joints q{0.1, -1.0, 0.6, 0.3, 0.7, 0.4};
  ASSERT_FALSE(drawn(q).first);
  const Transformd X = Chain(arm).forward(q);
  const auto stated =
      solutions.find(X, {.ranges = {}, .front = false, .elbow_front = drawn(q).second}, q);
  EXPECT_TRUE(stated.q.empty());
  EXPECT_NE(stated.why.find("behind axis 1"), std::string::npos) << stated.why;
  EXPECT_FALSE(solutions.find(X, {.ranges = {}, .front = false, .elbow_front = {}}, q).q.empty());
}

TEST(JointSolutions, APoseOutOfReachOrAConfigurationThatNoneHasGivesNoJoints) {
  const format::Chain arm = heavy_arm();
  const JointSolutions solutions(arm);
  Transformd far;
  far.p = {9.0, 0.0, 0.0};
  EXPECT_NE(solutions.find(far, {}, {}).why.find("does not reach"), std::string::npos);
  const Joints q{0.1, 0.2, 0.9, 0.3, 0.7, 0.4};
  Configuration other;
  other.ranges.push_back({0, 90.0, 100.0});
  const auto none = solutions.find(Chain(arm).forward(q), other, q);
  EXPECT_TRUE(none.q.empty());
  EXPECT_NE(none.why.find("configuration"), std::string::npos);
}

TEST(JointSolutions, TheControllersValuesOfACoupledArmAreNotItsAngles) {
  format::Chain arm = heavy_arm();
  arm.coupling = {{.joint = 2, .by = 1, .ratio = -1.0}};
  const JointSolutions solutions(arm);
  const std::vector<double> values{10, 20, 30, 40, 50, 60};
  const Joints q = solutions.of_controller(values);
  EXPECT_NEAR(q[2], 10.0 * kDeg, 1e-12);
  const auto back = solutions.to_controller(q);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(back[i], values[i], 1e-12);
  EXPECT_TRUE(solutions.of_controller(std::vector<double>{1, 2}).empty());
}

}  // namespace
}  // namespace plumb::offline::programs

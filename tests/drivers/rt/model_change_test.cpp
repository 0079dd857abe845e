// SPDX-License-Identifier: Apache-2.0
// Models whose difference is known in closed form: a base that stands elsewhere moves all that the
// arm does, and the correction the other way.
#include "rt/model_change.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/rt/one_arm.hpp"

namespace plumb::drivers::rt {
namespace {

/// An arm without any error.
format::Model exact_arm() {
  format::Model out = tests::one_arm();
  out.calibrated = out.nominal;
  out.trees = {};
  out.guard.corrects = format::Corrects::kPose;
  out.guard.max_correction_m = 0.05;
  out.guard.max_rotation_rad = 0.05;
  return out;
}

/// Its base stands elsewhere by so much [m].
format::Model shifted_arm(double x, double y, double z) {
  format::Model out = exact_arm();
  out.calibrated.base.p = {x, y, z};
  return out;
}

/// Its base is turned about the vertical axis [rad].
format::Model turned_arm(double angle) {
  format::Model out = exact_arm();
  out.calibrated.base.q = {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
  return out;
}

ModelChange between(format::Model running, format::Model next) {
  const auto a = LoadedModel::make(std::move(running)), b = LoadedModel::make(std::move(next));
  return find_change(*a, *b);
}

TEST(ModelChanges, AModelDoesNotDifferFromItself) {
  for (const format::Model& model : {tests::one_arm(), exact_arm(), turned_arm(1e-3)}) {
    const ModelChange none = between(model, model);
    EXPECT_EQ(none.position_m, 0.0);
    EXPECT_EQ(none.rotation_rad, 0.0);
    EXPECT_TRUE(none.q.empty());
    EXPECT_GT(none.compared, kComparedPoses / 2) << "that it is none was looked at";
  }
}

TEST(ModelChanges, ABaseThatStandsElsewhereIsSeenAtItsSizeInBothDirections) {
  for (const double size : {1e-5, 1e-3, 5e-3}) {
    const format::Model moved = shifted_arm(size, -2.0 * size, 2.0 * size);
    for (const ModelChange& change : {between(exact_arm(), moved), between(moved, exact_arm())}) {
      EXPECT_NEAR(change.position_m, 3.0 * size, 1e-8);
      EXPECT_NEAR(change.rotation_rad, 0.0, 1e-8);
      EXPECT_EQ(change.q.size(), 6U);
    }
  }
}

/// The tip moves by the angle times its distance from the axis, most where the arm reaches
/// furthest; the joint positions that are named are those of the largest change.
TEST(ModelChanges, ATurnedBaseIsSeenAsItsAngleAndAtThePoseThatIsNamed) {
  constexpr double kAngle = 2e-3;
  const ModelChange change = between(exact_arm(), turned_arm(kAngle));
  EXPECT_NEAR(change.rotation_rad, kAngle, 1e-8);
  ASSERT_EQ(change.q.size(), 6U);
  const Vector3 tip = Chain(exact_arm().nominal).forward(change.q).p;
  const double radius = std::hypot(tip(0), tip(1));
  EXPECT_NEAR(change.position_m, 2.0 * std::sin(0.5 * kAngle) * radius, 1e-8);
  EXPECT_GT(radius, 1.1) << "of a reach of 1.3 m";
}

/// Joint positions between these two, of all joints.
struct Box {
  double low, high;
  bool holds(const std::vector<double>& q) const {
    return std::all_of(q.begin(), q.end(), [&](double one) { return one >= low && one <= high; });
  }
};

/// A turned base moves the tip more where the arm is stretched: a change there must not be missed,
/// whether that is where the next model was trained or within the joint limits only. What runs was
/// trained everywhere.
TEST(ModelChanges, AreLookedForWhereTheModelWasTrainedAndWithinTheJointLimits) {
  const Box stretched{0.3, 0.4}, bent{2.3, 2.4};
  for (const bool trained_stretched : {true, false}) {
    const Box &trained = trained_stretched ? stretched : bent,
              &limits = trained_stretched ? bent : stretched;
    format::Model before = turned_arm(2e-3), after = exact_arm();
    for (format::Model* const model : {&before, &after})
      for (std::size_t j = 0; j < 6; ++j) {
        after.domain.q_min[j] = trained.low;
        after.domain.q_max[j] = trained.high;
        for (format::Chain* const chain : {&model->nominal, &model->calibrated}) {
          chain->joints[j].q_min = limits.low;
          chain->joints[j].q_max = limits.high;
        }
      }
    const ModelChange change = between(before, after);
    ASSERT_EQ(change.q.size(), 6U);
    EXPECT_TRUE(stretched.holds(change.q)) << change.q[0] << " " << change.q[2];
    EXPECT_GT(change.compared, kComparedPoses / 2) << "both kinds";
  }
}

TEST(ModelChanges, ModelsThatCorrectPositionsOnlyTurnNothing) {
  format::Model a = exact_arm(), b = turned_arm(2e-3);
  a.guard.corrects = b.guard.corrects = format::Corrects::kPosition;
  const ModelChange change = between(a, b);
  EXPECT_EQ(change.rotation_rad, 0.0);
  EXPECT_GT(change.position_m, 1e-3);
}

/// What is sent is what the guard lets through.
TEST(ModelChanges, NeverExceedWhatBothGuardsLetThrough) {
  format::Model west = shifted_arm(-0.02, 0.0, 0.0), east = shifted_arm(0.02, 0.0, 0.0);
  west.guard.max_correction_m = 0.002;
  east.guard.max_correction_m = 0.003;
  EXPECT_NEAR(between(exact_arm(), west).position_m, 0.002, 1e-8);
  EXPECT_NEAR(between(exact_arm(), east).position_m, 0.003, 1e-8);
  EXPECT_NEAR(between(west, east).position_m, 0.005, 1e-8);
  format::Model turned = turned_arm(0.01);
  turned.guard.max_rotation_rad = 0.004;
  EXPECT_NEAR(between(exact_arm(), turned).rotation_rad, 0.004, 1e-8);
}

TEST(ModelChanges, AreTheSameEveryTime) {
  const ModelChange once = between(exact_arm(), tests::one_arm());
  const ModelChange again = between(exact_arm(), tests::one_arm());
  EXPECT_GT(once.position_m, 1e-4);
  EXPECT_EQ(once.position_m, again.position_m);
  EXPECT_EQ(once.rotation_rad, again.rotation_rad);
  EXPECT_EQ(once.q, again.q);
  EXPECT_EQ(once.compared, again.compared);
}

}  // namespace
}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/corrector.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/runtime/true_arm.hpp"

namespace plumb {
namespace {

using test::Joints;

constexpr std::uint64_t kSeed = 20240607;

Joints near(test::RandomArm& random, Joints q, double distance) {
  for (auto& x : q) x += random.uniform(-distance, distance);
  return q;
}

Joints solution(const Correction& correction, std::size_t n) {
  return {correction.q.begin(), correction.q.begin() + static_cast<std::ptrdiff_t>(n)};
}

/// Errors of the whole loop, target to true arm, by evidence that is not the runtime's.
struct Loop {
  int targets = 0;
  int refused = 0;
  int partial = 0;
  int not_inverted = 0;
  double position = 0.0;     // [m]
  double orientation = 0.0;  // [rad], where the model corrects poses
  double kept = 0.0;         // [rad], where it keeps the controller's orientation
};

void correct_targets(test::RandomArm& random, const format::Model& model, int count, Loop& loop) {
  const Corrector corrector(model);
  const test::TrueArm arm(model);
  const test::NominalController controller(model.nominal);
  const bool pose = model.guard.corrects == format::Corrects::kPose;
  for (int k = 0; k < count; ++k) {
    const Joints wanted = random.positions(model.nominal);
    Transformd X_BD = arm.pose(wanted);
    // What fewer than six joints cannot turn is no part of a reachable target.
    if (!pose && wanted.size() < 6) X_BD.R = controller.pose(wanted).R;
    const Correction correction =
        corrector.solve(X_BD, near(random, wanted, 0.05), SeedKind::kCommanded);
    ++loop.targets;
    if (refused(correction.status)) {
      ++loop.refused;
      continue;
    }
    Joints q = near(random, solution(correction, wanted.size()), 1e-3);
    if (wanted.size() == 7) q = solution(correction, 7);
    if (!controller.invert(correction.X_BC, q)) ++loop.not_inverted;
    const Transformd X_BT = arm.pose(q);
    if (correction.status == Status::kPartial) {  // corrector_refusal_test, refusal_share_test
      ++loop.partial;
      continue;
    }
    loop.position = std::max(loop.position, (X_BT.p - X_BD.p).norm());
    const Eigen::Matrix3d& R = pose ? X_BT.R : correction.X_BC.R;
    double& angle = pose ? loop.orientation : loop.kept;
    angle = std::max(angle, test::small_rotation(X_BD.R * R.transpose()).norm());
  }
}

TEST(Corrector, BringsTheTrueArmOntoTheTargetThroughTheControllersOwnInverse) {
  constexpr int kModels = 5'000, kTargets = 20;
  std::printf("count %d seed %llu\n", kModels * kTargets, static_cast<unsigned long long>(kSeed));
  test::RandomArm random(kSeed);
  const auto kinds = test::arm_kinds();
  Loop loop;
  for (int k = 0; k < kModels; ++k) {
    const std::size_t kind = static_cast<std::size_t>(k) % (kinds.size() + 1);
    const auto nominal = kind < kinds.size() ? kinds[kind].nominal : test::random_6r(random);
    correct_targets(random, test::random_model(random, nominal), kTargets, loop);
  }
  std::printf("%d targets, %d refused; worst %.1e m, %.1e rad; kept orientation %.1e rad\n",
              loop.targets, loop.refused, loop.position, loop.orientation, loop.kept);
  EXPECT_EQ(loop.not_inverted, 0);
  EXPECT_LT(loop.refused, loop.targets / 8);
  EXPECT_LT(loop.partial, loop.targets / 20);
  // The last step leaves about a thousandth of what it moved, at most 1 um and 1 urad.
  EXPECT_LT(loop.position, 5e-9);
  EXPECT_LT(loop.orientation, 5e-9);
  EXPECT_LT(loop.kept, 5e-9);
}

format::Model exact(const format::Chain& nominal) {
  format::Model model;
  model.nominal = nominal;
  model.calibrated = nominal;
  return model;
}

TEST(Corrector, LeavesTheTargetAloneWhenTheArmIsAsTheControllerBelieves) {
  test::RandomArm random(kSeed);
  const Corrector corrector(exact(test::ur10()));
  for (int k = 0; k < 1'000; ++k) {
    const Joints q = random.positions(test::ur10());
    const Transformd X_BD = corrector.nominal().forward(q);
    const auto correction = corrector.solve(X_BD, q, SeedKind::kMeasured);
    if (refused(correction.status)) continue;
    EXPECT_LT((correction.X_BC.p - X_BD.p).norm(), 1e-14);
    EXPECT_LT((correction.X_BC.R - X_BD.R).norm(), 1e-14);
  }
}

TEST(Corrector, IgnoresAnOrientationThatNoJointIsFreeToReach) {
  test::RandomArm random(kSeed);
  const auto model = test::random_model(random, test::planar(2));
  const Corrector corrector(model);
  const Joints q{0.4, 0.9};
  Transformd X_BD = test::TrueArm(model).pose(q);
  const auto first = corrector.solve(X_BD, q, SeedKind::kMeasured);
  X_BD.R = from_pose(random.pose(1.0)).R;
  const auto second = corrector.solve(X_BD, q, SeedKind::kMeasured);
  EXPECT_FALSE(refused(first.status));
  EXPECT_EQ(first.status, second.status);
  EXPECT_EQ(first.q, second.q);
}

TEST(Corrector, MeetsThePositionBeforeTheOrientationWithFiveAxes) {
  test::RandomArm random(kSeed);
  double worst = 0.0;
  int solved = 0;
  for (int k = 0; k < 1'000; ++k) {
    const auto model = test::random_model(random, test::five_axes());
    const test::TrueArm arm(model);
    const Joints q = random.positions(model.nominal);
    Transformd X_BD = arm.pose(q);
    X_BD.R = from_pose({{}, {0.9999995, 5e-4, -5e-4, 7e-4}}).R * X_BD.R;
    for (int j = 0; j < 3; ++j) {  // a proper rotation again
      for (int i = 0; i < j; ++i) X_BD.R.col(j) -= X_BD.R.col(i).dot(X_BD.R.col(j)) * X_BD.R.col(i);
      X_BD.R.col(j).normalize();
    }
    const auto correction = Corrector(model).solve(X_BD, q, SeedKind::kMeasured);
    if (refused(correction.status)) continue;
    ++solved;
    worst = std::max(worst, (arm.pose(solution(correction, 5)).p - X_BD.p).norm());
  }
  EXPECT_GT(solved, 800);
  EXPECT_LT(worst, 1e-9);
}

TEST(Corrector, GivesTheSameBitsAndTheSameStepsEveryTime) {
  test::RandomArm random(kSeed);
  const Corrector corrector(test::random_model(random, test::tx200()));
  for (int k = 0; k < 1'000; ++k) {
    const Joints q = random.positions(test::tx200());
    const Transformd X_BD = corrector.forward_model().predict(q).X_BT;
    const Joints seed = near(random, q, 0.3);
    const auto a = corrector.solve(X_BD, seed, SeedKind::kMeasured);
    const auto b = corrector.solve(X_BD, seed, SeedKind::kMeasured);
    EXPECT_EQ(a.q, b.q);
    EXPECT_EQ(a.X_BC.p, b.X_BC.p);
    EXPECT_EQ(a.steps, Corrector::kInverseSteps);
    EXPECT_EQ(b.steps, Corrector::kInverseSteps);
  }
}

TEST(Corrector, ConvergesWhereEffectsMoveTheToolByMillimetresAndMilliradians) {
  test::RandomArm random(kSeed);
  auto model = exact(test::ur10());
  const format::Effect compliance{
      .name = "joint_compliance", .joints = {1, 2}, .parameters = {1e-5, 1.5e-5}, .context = {}};
  model.effects = {compliance};
  for (int j = 0; j < 6; ++j) model.mechanics.links.push_back({30.0 - 5.0 * j, {0.1, 0.0, 0.05}});
  int solved = 0;
  double moved = 0.0, worst = 0.0;
  for (const auto corrects : {format::Corrects::kPose, format::Corrects::kPosition}) {
    model.guard.corrects = corrects;
    const Corrector corrector(model);
    for (int k = 0; k < 2'000; ++k) {
      const Joints q = random.positions(model.nominal);
      const Transformd X_BD = corrector.nominal().forward(q);
      const auto correction = corrector.solve(X_BD, near(random, q, 0.05), SeedKind::kCommanded);
      if (refused(correction.status) || correction.status == Status::kPartial) continue;
      ++solved;
      const auto found = corrector.forward_model().predict(solution(correction, 6));
      worst = std::max(worst, (found.X_BT.p - X_BD.p).norm());
      moved = std::max(moved, (correction.X_BC.p - X_BD.p).norm());
    }
  }
  EXPECT_GT(moved, 4e-3);
  EXPECT_GT(solved, 3'300);
  // The last step does not see how the effects change with it: half a per cent of it, here.
  EXPECT_LT(worst, 1e-8);
}

TEST(Corrector, SaysWhenTheSolutionLiesOutsideTheTrainedDomain) {
  test::RandomArm random(kSeed);
  auto model = exact(test::ur10());
  const Joints q{0.3, -1.2, 1.4, -0.5, 1.0, 0.2};
  for (double x : q) {
    model.domain.q_min.push_back(x - 1.0);
    model.domain.q_max.push_back(x - 0.05);
  }
  model.trees[2].coefficients.assign(7, 1e-4);
  model.trees[2].bounds = {-1e-3, 1e-3};
  const Corrector corrector(model);
  const auto X_BD = corrector.forward_model().predict(q);
  ASSERT_EQ(X_BD.status, Status::kOutsideDomain);
  EXPECT_EQ(corrector.solve(X_BD.X_BT, q, SeedKind::kMeasured).status, Status::kOutsideDomain);
}

}  // namespace
}  // namespace plumb

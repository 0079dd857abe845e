// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/single_poses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/rt/one_arm.hpp"

namespace plumb::tests {
namespace {

const std::vector<double> kSeed{0.1, -1.2, 1.4, 0.3, 1.1, -0.3};

TEST(SinglePoses, CorrectNothingLargerThanTheGuardAllowsAndThenTheySaySo) {
  format::GuardLimits limits;
  limits.corrects = format::Corrects::kPose;
  limits.max_correction_m = 1e-3;
  limits.max_rotation_rad = 1e-3;
  const Transformd X_BD;
  Correction c;
  c.status = Status::kOk;
  c.X_BC.p = Vector3(3e-3, 0.0, 4e-3);
  c.X_BC.R = rotation_of(Vector3(0.0, 5e-3, 0.0));
  const Correction cut = guarded(c, X_BD, limits);
  EXPECT_EQ(cut.status, Status::kLimited);
  EXPECT_NEAR((cut.X_BC.p - Vector3(0.6e-3, 0.0, 0.8e-3)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(rotation_vector(cut.X_BC.R).norm(), 1e-3, 1e-12);
  c.X_BC.p *= 0.1;
  c.X_BC.R = Matrix3::Identity();
  EXPECT_EQ(guarded(c, X_BD, limits).status, Status::kOk);
  EXPECT_EQ(guarded(c, X_BD, limits).X_BC.p, c.X_BC.p);
}

TEST(SinglePoses, AreThoseOfTheCorrectorWithinTheLimits) {
  const format::Model model = one_arm();
  const SinglePoses poses(model);
  const Transformd X_BD = poses.corrector().nominal().forward(kSeed);
  const Correction one = poses.correct(X_BD, kSeed, SeedKind::kMeasured, {});
  const Correction same = Corrector(model).solve(X_BD, kSeed, SeedKind::kMeasured, {});
  EXPECT_EQ(one.status, Status::kOk);
  EXPECT_EQ(one.X_BC.p, same.X_BC.p);
  EXPECT_EQ(one.X_BC.R, same.X_BC.R);
  const Prediction there = poses.predict(std::span(one.q).first(6), {});
  EXPECT_EQ(there.status, Status::kOk);
  EXPECT_LT((there.X_BT.p - X_BD.p).norm(), 1e-9);
}

TEST(SinglePoses, SayWhereTheGuardWouldCutAndPredictTheWholeError) {
  format::Model model = one_arm();
  const Prediction whole = SinglePoses(model).predict(kSeed, {});
  model.guard.max_correction_m = 1e-6;
  const Prediction beyond = SinglePoses(model).predict(kSeed, {});
  EXPECT_EQ(beyond.status, Status::kLimited);
  EXPECT_EQ(beyond.X_BT.p, whole.X_BT.p);
}

TEST(SinglePoses, SayThatAJointLiesOutsideWhatWasFitted) {
  const format::Model model = one_arm();
  std::vector<double> q = kSeed;
  q[5] = 3.5;
  EXPECT_EQ(SinglePoses(model).predict(q, {}).status, Status::kOutsideDomain);
}

/// A target that is no pose is refused, whatever the context is.
TEST(SinglePoses, RefuseWhatIsNoTarget) {
  format::Model model = one_arm();
  model.domain.context = {{format::ContextInput::kPayload, "", 0.0, 1.0}};
  const SinglePoses poses(model);
  Context heavy;
  heavy.payload_kg = 1e6;
  const Transformd X_BD = poses.corrector().nominal().forward(kSeed);
  Transformd none = X_BD;
  none.p(1) = NAN;
  std::vector<double> seed = kSeed;
  seed[2] = NAN;
  EXPECT_EQ(poses.correct(none, kSeed, SeedKind::kMeasured, heavy).status, Status::kNotFinite);
  EXPECT_EQ(poses.correct(X_BD, seed, SeedKind::kMeasured, heavy).status, Status::kNotFinite);
  const Correction faded = poses.correct(X_BD, kSeed, SeedKind::kMeasured, heavy);
  EXPECT_EQ(faded.status, Status::kOutsideDomain);
  EXPECT_EQ(faded.X_BC.p, X_BD.p);
}

}  // namespace
}  // namespace plumb::tests

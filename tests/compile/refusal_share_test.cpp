// SPDX-License-Identifier: Apache-2.0
// Where the inverse refuses, and that a correction near singular poses never makes a position
// worse.
#include "compile/refusal_share.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "cell/random.hpp"
#include "plumb/runtime/corrector.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::offline {
namespace {

using Joints = Eigen::Matrix<double, 6, 1>;

constexpr double kRange = std::numbers::pi;

/// An arm of UR10 size whose parts are off by up to `mm` and as many mrad, corrected in position.
format::Model arm(double mm) {
  format::Model out = tests::one_arm();
  out.trees = {};  // a crisp tree steps at the borders of its leaves, whatever the correction does
  Random random(3);
  for (std::size_t i = 0; i < out.nominal.joints.size(); ++i) {
    auto &is = out.calibrated.joints[i], &was = out.nominal.joints[i];
    was.q_min = -kRange, was.q_max = kRange;
    is = was;
    for (double* x : {&is.alpha, &is.a, &is.theta, &is.d})
      *x += 1e-3 * mm * (2.0 * random.unit() - 1.0);
  }
  out.guard.length_scale_m = 1.3;
  out.guard.max_correction_m = 0.02;
  out.guard.min_singular_value = 3e-4;  // as compile() has it
  out.domain.q_min.assign(6, -3.2);
  out.domain.q_max.assign(6, 3.2);
  return out;
}

/// The controller's own inverse, independent of the corrector's: damped least squares with
/// differences for a Jacobian, from the joints of the target. False if it does not get there.
bool controller_reaches(const Chain& nominal, const Transformd& X_BC, Joints& q) {
  const auto at = [&](const Joints& joints) {
    return nominal.forward(std::span<const double>(joints.data(), 6));
  };
  const auto error = [&](const Transformd& X) {
    Joints e;
    e << X_BC.p - X.p, rotation_vector(times_transposed<double>(X_BC.R, X.R));
    return e;
  };
  for (int k = 0; k < 100; ++k) {
    const Transformd now = at(q);
    const Joints e = error(now);
    if (e.norm() < 1e-10) return true;
    Eigen::Matrix<double, 6, 6> J;
    for (int j = 0; j < 6; ++j) {
      Joints moved = q;
      moved(j) += 1e-6;
      J.col(j) = -(error(at(moved)) - e) / 1e-6;
    }
    const double damping = 1e-3 * e.norm();
    const Eigen::Matrix<double, 6, 6> square =
        J.transpose() * J + damping * Eigen::Matrix<double, 6, 6>::Identity();
    q += square.ldlt().solve(J.transpose() * e);
  }
  return false;
}

TEST(RefusalShare, OfAnArmOfUR10SizeIsAtMostThreePercentAndSaidWithItsPlaces) {
  for (const double mm : {0.5, 1.5, 3.0}) {
    const format::Model model = arm(mm);
    const RefusalShare share = refusal_share(model);
    EXPECT_LE(share.limits.refused, 0.03) << mm;
    EXPECT_GT(share.limits.refused, 0.001) << mm;
    EXPECT_GT(share.limits.partial, share.limits.refused) << mm;
    const std::string said = refusal_sentence(share, model.nominal);
    std::printf("%s\n", said.c_str());
    EXPECT_NE(said.find("deg of 0 or 180 deg"), std::string::npos) << said;
    EXPECT_EQ(said.rfind("Of 4000 random poses in the trained range ", 0), 0U) << said;
  }
  format::Model usual = arm(1.0);
  usual.guard.corrects = format::Corrects::kPose;
  usual.guard.min_singular_value = 0.02;
  const RefusalShare share = refusal_share(usual);
  EXPECT_GT(share.limits.refused, 0.1);
  EXPECT_EQ(share.limits.partial, 0.0);
}

// The share of the trained range is the one that a user meets: far from singular poses little is
// refused there, whatever is between the joint limits.
TEST(RefusalShare, OfTheTrainedRangeIsCountedByItself) {
  format::Model model = arm(1.5);
  model.guard.corrects = format::Corrects::kPose;
  model.guard.min_singular_value = 0.02;
  const std::size_t elbow = 2, wrist = 4;
  model.domain.q_min[elbow] = 1.0;
  model.domain.q_max[elbow] = 1.6;
  for (const auto& [low, high] : {std::pair{0.8, 1.4}, std::pair{-0.02, 0.02}}) {
    model.domain.q_min[wrist] = low;
    model.domain.q_max[wrist] = high;
    const RefusalShare share = refusal_share(model);
    if (low > 0.0)
      EXPECT_LT(share.trained.refused, 0.5 * share.limits.refused);
    else
      EXPECT_GT(share.trained.refused, 0.9) << "the wrist is stretched everywhere";
  }
}

TEST(RefusalShare, PlacesAreFoundWhereRefusalsWereMade) {
  const format::Model model = arm(1.0);
  Random random(5);
  std::vector<PoseTried> all(20'000);
  for (PoseTried& one : all) {
    for (int j = 0; j < 6; ++j) one.q.push_back(kRange * (2.0 * random.unit() - 1.0));
    const auto near = [&](std::size_t j, double at, double within) {
      return std::abs(std::remainder(one.q[j] - at, kRange)) < within;
    };
    one.refused = near(4, 0.0, 3.0 * kRange / 180.0) || near(2, kRange / 2, kRange / 180.0);
  }
  const auto places = refused_places(all, model.nominal);
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].joint, 4U);
  EXPECT_NEAR(places[0].at, 0.0, 1e-9);
  EXPECT_NEAR(places[0].within, 3.0 * kRange / 180.0, 1e-9);
  EXPECT_NEAR(places[0].share, 6.0 / 180.0, 0.005);
  EXPECT_EQ(places[1].joint, 2U);
  EXPECT_NEAR(places[1].at, kRange / 2, 1e-9);
  EXPECT_NEAR(places[1].within, kRange / 180.0, 1e-9);
  for (PoseTried& one : all) one.refused = false;
  EXPECT_TRUE(refused_places(all, model.nominal).empty());
}

/// Random poses of the whole joint range, by the controller's own inverse from the joints of the
/// target. PLUMB_REFUSAL_POSES asks for more of them; the figures of a million are in
/// docs/safety.md.
TEST(RefusalShare, NoPositionIsWorseThanWithoutCorrection) {
  const char* asked = std::getenv("PLUMB_REFUSAL_POSES");
  const int poses = asked ? std::atoi(asked) : 4'000;
  for (const double mm : {0.5, 2.0}) {
    const format::Model model = arm(mm);
    const Corrector corrector(model);
    const Chain& nominal = corrector.nominal();
    Random random(7);
    int refusals = 0, partial = 0, full = 0, worse = 0, not_reached = 0;
    double without_mm = 0.0, with_mm = 0.0, farthest = 0.0;
    for (int i = 0; i < poses; ++i) {
      Joints q;
      for (int j = 0; j < 6; ++j) q(j) = kRange * (2.0 * random.unit() - 1.0);
      const std::span<const double> seed(q.data(), 6);
      const Transformd X_BD = nominal.forward(seed);
      const Correction found = corrector.solve(X_BD, seed, SeedKind::kCommanded);
      refusals += refused(found.status);
      if (refused(found.status)) continue;
      partial += found.status == Status::kPartial;
      full += found.status == Status::kOk;
      const auto miss_mm = [&](const Joints& joints) {
        const std::span<const double> at(joints.data(), 6);
        return 1e3 * (corrector.forward_model().predict(at).X_BT.p - X_BD.p).norm();
      };
      Transformd X_BC = found.X_BC;
      X_BC.R = X_BD.R;  // a guard of positions leaves the orientation as it is
      Joints there = q;
      not_reached += !controller_reaches(nominal, X_BC, there);
      farthest = std::max(farthest, (there - q).cwiseAbs().maxCoeff());
      without_mm += miss_mm(q), with_mm += miss_mm(there);
      worse += miss_mm(there) > miss_mm(q) + 1e-3;
    }
    const double accepted = poses - refusals;
    std::printf(
        "%d poses: refused %.2f %%, in part %.2f %%, not reached %d, worse %d, error %.3f mm "
        "without and %.4f mm with, a joint moved by %.3f rad at most\n",
        poses, 100.0 * refusals / poses, 100.0 * partial / poses, not_reached, worse,
        without_mm / accepted, with_mm / accepted, farthest);
    EXPECT_LE(refusals, 0.03 * poses);
    EXPECT_EQ(worse, 0);
    EXPECT_EQ(not_reached, 0);
    EXPECT_LT(farthest, model.guard.max_seed_distance + 1e-3);
    EXPECT_GT(full, 0.75 * poses);
    EXPECT_GT(partial, 0.005 * poses);
    EXPECT_LT(with_mm, 0.1 * without_mm);
  }
}

}  // namespace
}  // namespace plumb::offline

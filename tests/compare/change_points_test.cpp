// SPDX-License-Identifier: Apache-2.0
#include "noise/change_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "compare/autocorrelation.hpp"
#include "residual_cases.hpp"

namespace plumb::offline::compare {
namespace {

constexpr double kSigma = 1e-5;
constexpr int kPoses = 120;

struct Mark {
  MotionSource source;
  int joint;
  double size_m;
};

TEST(ChangePoints, AStepIsFoundWithinOnePoseAndGivenToWhatMovedInNinetyFiveOfAHundredSeeds) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ seeds    ] 1 .. %d of each mover\n", count);
  for (const Mark& mark :
       {Mark{MotionSource::kTool, -1, 5 * kSigma}, Mark{MotionSource::kBase, -1, 5 * kSigma},
        Mark{MotionSource::kJoint, 1, 6 * kSigma}, Mark{MotionSource::kJoint, 2, 8 * kSigma}}) {
    int near = 0, right = 0, covered = 0;
    double off = 0.0;
    for (int seed = 1; seed <= count; ++seed) {
      ResidualCase at(static_cast<std::uint64_t>(seed), kPoses);
      at.add_noise(kSigma);
      const int last = 20 + at.random.below(kPoses - 40);
      const ArmState other = moved_state(at, mark.source, mark.joint, mark.size_m);
      at.add_change(other, [&](int i) { return i > last ? 1.0 : 0.0; });
      const Changes found = change_points(at.motions());
      if (found.steps.size() != 1 || !found.drifts.empty()) continue;
      const StepFound& step = found.steps[0];
      near += std::abs(step.before - last) <= 1 ? 1 : 0;
      right += step.source == mark.source && step.joint == mark.joint ? 1 : 0;
      covered += step.earliest <= last && last <= step.latest ? 1 : 0;
      if (mark.source == MotionSource::kTool && step.source == mark.source)
        for (int k = 0; k < 3; ++k)
          off = std::max(off, std::abs(step.shift(k) - other.X_TG.p[k] + at.state.X_TG.p[k]));
      if (mark.source == MotionSource::kJoint && step.source == mark.source)
        off = std::max(off, std::abs(step.shift(0) - mark.size_m));
    }
    std::printf("[ mover %d  ] within 1 pose %d, right mover %d, covered %d of %d\n",
                static_cast<int>(mark.source), near, right, covered, count);
    EXPECT_GE(near, 0.95 * count);
    EXPECT_GE(right, 0.95 * count);
    EXPECT_GE(covered, 0.9 * count);
    EXPECT_LT(off, 4.0 * kSigma);
  }
}

/// Nearest neighbour after nearest neighbour, as an arm is driven.
void drive_shortest(ResidualCase& at) {
  for (int i = 1; i < at.size(); ++i) {
    int best = i;
    for (int k = i; k < at.size(); ++k)
      if ((at.measured.q.row(k) - at.measured.q.row(i - 1)).norm() <
          (at.measured.q.row(best) - at.measured.q.row(i - 1)).norm())
        best = k;
    at.measured.q.row(i).swap(at.measured.q.row(best));
  }
}

TEST(ChangePoints, NothingIsFoundInNinetyFiveOfAHundredSeriesInWhichNothingHappened) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ seeds    ] 1 .. %d of each kind\n", count);
  int white = 0, remembering = 0, structured = 0;
  for (int seed = 1; seed <= count; ++seed) {
    ResidualCase at(static_cast<std::uint64_t>(seed), kPoses);
    at.add_noise(kSigma);
    white += change_points(at.motions()).steps.empty() ? 1 : 0;
    for (int i = 1; i < kPoses; ++i) at.error.row(i) += 0.5 * at.error.row(i - 1);
    remembering += change_points(at.motions()).steps.empty() ? 1 : 0;
    ResidualCase lacking(static_cast<std::uint64_t>(seed), kPoses);
    drive_shortest(lacking);
    lacking.add_noise(kSigma);
    ArmState bent = lacking.state;
    bent.arm.calibrated.joints[3].theta += 1e-4;
    lacking.add_change(bent, [&](int i) { return std::sin(3.0 * lacking.measured.q(i, 3)); });
    structured += change_points(lacking.motions()).steps.empty() ? 1 : 0;
  }
  std::printf("[ clean    ] white %d, autoregressive %d, unmodelled joint law %d of %d\n", white,
              remembering, structured, count);
  EXPECT_GE(white, 0.95 * count);
  EXPECT_GE(remembering, 0.95 * count);
  EXPECT_GE(structured, 0.95 * count);
}

TEST(ChangePoints, ASmoothDriftIsNoStep) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  int drifts = 0, steps = 0;
  double size = 0.0;
  for (int seed = 1; seed <= count; ++seed) {
    ResidualCase at(static_cast<std::uint64_t>(seed), kPoses);
    at.add_noise(kSigma);
    const ArmState other = moved_state(at, MotionSource::kBase, -1, 10 * kSigma);
    at.add_change(other, [&](int i) { return static_cast<double>(i) / kPoses; });
    const Changes found = change_points(at.motions());
    drifts += found.drifts.size() == 1 ? 1 : 0;
    steps += found.steps.empty() ? 0 : 1;
    if (!found.drifts.empty()) size += found.drifts[0].size_m / count;
  }
  EXPECT_GE(drifts, 0.95 * count);
  EXPECT_LE(steps, 0.05 * count);
  EXPECT_NEAR(size, 9.5 * kSigma, 2.0 * kSigma);
}

TEST(ChangePoints, SeveralStepsAreFoundInTheirOrder) {
  const int count = static_cast<int>(tests::scaled(50));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  int all = 0;
  for (int seed = 1; seed <= count; ++seed) {
    ResidualCase at(static_cast<std::uint64_t>(seed), 200);
    at.add_noise(kSigma);
    at.add_change(moved_state(at, MotionSource::kTool, -1, 8 * kSigma),
                  [](int i) { return i > 59 ? 1.0 : 0.0; });
    at.add_change(moved_state(at, MotionSource::kJoint, 1, 10 * kSigma),
                  [](int i) { return i > 129 ? 1.0 : 0.0; });
    const Changes found = change_points(at.motions());
    all += found.steps.size() == 2 && std::abs(found.steps[0].before - 59) <= 1 &&
                   std::abs(found.steps[1].before - 129) <= 1
               ? 1
               : 0;
  }
  EXPECT_GE(all, 0.95 * count);
}

TEST(ChangePoints, AMissingAxisAndAHandfulOfPosesAreNoTrouble) {
  ResidualCase flat(3, kPoses);
  flat.add_noise(kSigma);
  flat.measured.has_axis = {true, true, false};
  flat.error.col(2).setZero();
  ArmState other = moved_state(flat, MotionSource::kTool, -1, 10 * kSigma);
  flat.add_change(other, [](int i) { return i > 50 ? 1.0 : 0.0; });
  flat.error.col(2).setZero();
  const Changes found = change_points(flat.motions());
  ASSERT_EQ(found.steps.size(), 1U);
  EXPECT_NEAR(found.steps[0].before, 50, 1);
  EXPECT_EQ(change_points(ResidualCase(1, 8).motions()).visits, 0);
}

}  // namespace
}  // namespace plumb::offline::compare

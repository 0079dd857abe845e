// SPDX-License-Identifier: Apache-2.0
// A frame that the cell file gives, against the points that were measured in it.
#include "check/given_frame.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "plumb/runtime/chain.hpp"
#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// An arm without errors or noise, in a frame and with a reflector that its cell file gives.
SimulatedArm in_given_frame(std::uint64_t seed) {
  Cell cell = six_joint_cell(seed);
  SimulationPlan plan = plan_of_arm(seed, 60, 0.0);
  plan.noise_m = 0.0;
  plan.truth.X_MB = format::Pose{{1.5, -0.4, 0.3}, {0.8, 0.0, 0.36, 0.48}};
  plan.truth.target_T = {0.06, -0.03, 0.12};
  SimulatedArm out = measured_by(std::move(cell), plan);
  out.cell.measurement.fit_frame = out.cell.measurement.fit_target = false;
  out.cell.measurement.X_MB = *plan.truth.X_MB;
  out.cell.measurement.target_T = *plan.truth.target_T;
  return out;
}

/// The cell with a frame that is moved so, seen from the base.
Cell with_frame_off(const Cell& cell, const Eigen::AngleAxisd& turn, const Vector3& shift) {
  Transformd X_off;
  X_off.R = turn.toRotationMatrix();
  X_off.p = shift;
  Cell out = cell;
  out.measurement.X_MB = to_pose(from_pose(cell.measurement.X_MB) * X_off);
  return out;
}

const Eigen::AngleAxisd kNoTurn(0.0, Eigen::Vector3d::UnitZ());

TEST(MisfitInGivenFrame, IsNothingInTheRightFrameAndTheShiftInAnother) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const SimulatedArm at = in_given_frame(seed);
    EXPECT_LT(misfit_in_given_frame(at.cell, at.measured, at.rows), 1e-9);
    const Vector3 shift(0.01, -0.02, 0.005);
    EXPECT_NEAR(
        misfit_in_given_frame(with_frame_off(at.cell, kNoTurn, shift), at.measured, at.rows),
        shift.norm(), 1e-9);
  }
}

TEST(MisfitInGivenFrame, OfAFittedReflectorIsNothingWhereverItSits) {
  SimulatedArm at = in_given_frame(2);
  at.cell.measurement.target_T = {0.0, 0.0, 0.0};
  EXPECT_GT(misfit_in_given_frame(at.cell, at.measured, at.rows), 0.05);
  at.cell.measurement.fit_target = true;
  EXPECT_LT(misfit_in_given_frame(at.cell, at.measured, at.rows), 1e-6);
}

TEST(MisfitInGivenFrame, CountsTheMeasuredAxesAlone) {
  SimulatedArm at = in_given_frame(2);
  at.measured.p_M.col(2).array() += 0.5;
  EXPECT_NEAR(misfit_in_given_frame(at.cell, at.measured, at.rows), 0.5, 1e-9);
  at.measured.has_axis[2] = false;
  EXPECT_LT(misfit_in_given_frame(at.cell, at.measured, at.rows), 1e-9);
}

std::optional<Problem> fault_of(const SimulatedArm& at, const Cell& cell) {
  return given_frame_fault(cell, at.measured, at.rows);
}

/// About an axis of its own that the first joint does not turn about.
TEST(GivenFrame, ThatIsTurnedIsSaidWithTheAngleThatMendsIt) {
  const SimulatedArm at = in_given_frame(3);
  const char* names = "xyz";
  for (int axis = 0; axis < 3; ++axis)
    for (const double degrees : {3.0, 37.0, 90.0}) {
      const Eigen::AngleAxisd turn(degrees * kDegree, Eigen::Vector3d::Unit(axis));
      const auto found = fault_of(at, with_frame_off(at.cell, turn, Vector3::Zero()));
      ASSERT_TRUE(found) << degrees << " about " << names[axis];
      EXPECT_EQ(found->code, "E-CHECK-FRAME");
      EXPECT_TRUE(
          holds(found->message, fmt::format("turned by {:.1f} deg about {}", degrees, names[axis])))
          << found->message;
      // A frame that is turned about the first joint looks like that joint's zero.
      EXPECT_EQ(holds(found->help, "cannot tell the two apart"), axis == 2) << found->help;
    }
}

TEST(GivenFrame, ThatIsMovedIsSaidWithTheDistance) {
  const SimulatedArm at = in_given_frame(3);
  const auto found = fault_of(at, with_frame_off(at.cell, kNoTurn, Vector3(0.0, 0.25, 0.0)));
  ASSERT_TRUE(found);
  EXPECT_TRUE(holds(found->message, "it is 250 mm off along its y")) << found->message;
  const auto askew = fault_of(at, with_frame_off(at.cell, kNoTurn, Vector3(0.03, 0.04, 0.12)));
  ASSERT_TRUE(askew);
  EXPECT_TRUE(holds(askew->message, "it is 130 mm off")) << askew->message;
}

TEST(GivenFrame, InAnotherUnitIsSaidWithThatUnit) {
  const SimulatedArm at = in_given_frame(3);
  for (const auto& [factor, words] :
       {std::pair{1e-3, "in m instead of mm"}, std::pair{1e3, "in mm instead of m"},
        std::pair{1.0 / 25.4, "in inches instead of mm"}}) {
    Cell cell = at.cell;
    for (double& x : cell.measurement.X_MB.p) x *= factor;
    const auto found = fault_of(at, cell);
    ASSERT_TRUE(found) << words;
    EXPECT_TRUE(holds(found->message, words)) << found->message;
  }
}

TEST(GivenFrame, IsNotAccusedWhereItIsRightOrFittedOrThePointsFitNowhere) {
  SimulatedArm at = in_given_frame(3);
  EXPECT_FALSE(fault_of(at, at.cell));
  Cell fitted = with_frame_off(at.cell, kNoTurn, Vector3(0.0, 0.25, 0.0));
  EXPECT_TRUE(fault_of(at, fitted));
  fitted.measurement.fit_frame = true;
  EXPECT_FALSE(fault_of(at, fitted));
  const Cell off = with_frame_off(at.cell, kNoTurn, Vector3(0.0, 0.25, 0.0));
  at.measured.q.col(1) *= -1.0;
  EXPECT_FALSE(fault_of(at, off)) << "the joints are what is wrong";
}

Convention labels_of(const SimulatedArm& at) { return labelled_convention(at.cell, at.measured); }

Convention found_for(const SimulatedArm& at, const Convention& best) {
  Interpretation interpretation;
  interpretation.convention = best;
  return with_given_frame(at.cell, at.measured, at.rows, labels_of(at), interpretation);
}

TEST(WithGivenFrame, LeavesWhatFitsTheFrame) {
  const SimulatedArm at = in_given_frame(2);
  EXPECT_EQ(found_for(at, labels_of(at)), labels_of(at));
}

TEST(WithGivenFrame, FindsTheAxisThatIsMirrored) {
  for (int axis = 0; axis < 3; ++axis) {
    SimulatedArm at = in_given_frame(2);
    at.measured.p_M.col(axis) *= -1.0;
    // A search with a free frame knows only that the file is left-handed.
    Convention any = labels_of(at);
    any.mirror = axis == 0 ? Mirror::kSwapXY : Mirror::kNegateX;
    const Mirror expected[] = {Mirror::kNegateX, Mirror::kNegateY, Mirror::kNegateZ};
    EXPECT_EQ(found_for(at, any).mirror, expected[axis]) << axis;
    EXPECT_FALSE(found_for(at, any).frame_inverted);
  }
}

TEST(WithGivenFrame, FindsAFrameThatIsTheTrackerInTheBase) {
  SimulatedArm at = in_given_frame(2);
  at.cell.measurement.X_MB = to_pose(from_pose(at.cell.measurement.X_MB).inverse());
  at.cell.text = write_cell(at.cell);
  EXPECT_TRUE(found_for(at, labels_of(at)).frame_inverted);
  EXPECT_EQ(found_for(at, labels_of(at)).mirror, Mirror::kNone);
}

TEST(WithGivenFrame, KeepsTheInterpretationThatNoFrameOfTheseMakesMuchBetter) {
  SimulatedArm at = in_given_frame(2);
  at.cell = with_frame_off(at.cell, Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()),
                           Vector3(0.3, 0.1, 0.2));
  EXPECT_EQ(found_for(at, labels_of(at)), labels_of(at));
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
// Which cause of large errors is named, where there are several or none.
#include "check/error_cause.hpp"

#include <gtest/gtest.h>

#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

constexpr int kPoses = 90;
const Eigen::RowVector3d kFar_M(9e-3, -12e-3, 8e-3);

/// A joint that counts the other way in the last third of the file.
void turn_sign(SimulatedArm& at) { at.measured.q.col(2).tail(kPoses / 3) *= -1.0; }

/// A tracker that was pushed half way.
void push(SimulatedArm& at) {
  for (int i = kPoses / 2; i < kPoses; ++i) at.measured.p_M.row(i) += kFar_M;
}

/// Every second reading with the other face of the instrument.
void alternate(SimulatedArm& at) {
  for (int i = 0; i < kPoses; i += 2) at.measured.p_M.row(i) += 0.1 * kFar_M;
}

/// Every fourth reading by another station: a pattern, and a part that contradicts the rest.
void take_turns(SimulatedArm& at) {
  for (int i = 1; i < kPoses; i += 4) at.measured.p_M.row(i) += 0.2 * kFar_M;
}

/// A fifth of the readings, in no order, with another tool.
void contradict(SimulatedArm& at) {
  for (const int row : {2, 7, 8, 15, 19, 26, 30, 37, 41, 44, 52, 53, 60, 66, 69, 75, 80, 88})
    at.measured.p_M.row(row) += 0.2 * kFar_M;
}

struct Known {
  std::optional<GrossScale> scale = std::nullopt;
  bool fits = true;
  bool otherwise_meant = false, setups_moved = false;
};

ErrorCause cause_of(const SimulatedArm& at, const Known& known = {}) {
  Calibration placed;
  placed.state = place_nominal(at.cell, at.measured, at.rows);
  return error_cause(at.cell, at.measured, at.rows,
                     {.placed = placed.state,
                      .fit = known.fits ? &placed : nullptr,
                      .scale = known.scale,
                      .otherwise_meant = known.otherwise_meant,
                      .setups_moved = known.setups_moved});
}

std::string code_of(const ErrorCause& cause) {
  return cause.findings.empty() ? "" : cause.findings.front().code;
}

template <class... Spoil>
SimulatedArm arm_with(Spoil... spoil) {
  SimulatedArm out = simulated_arm(2, kPoses);
  (spoil(out), ...);
  return out;
}

Known with_scale() {
  Known out;
  out.scale = GrossScale{{.code = "W-CHECK-SCALE"}, false};
  return out;
}

TEST(ErrorCause, IsTheOneThatIsThere) {
  EXPECT_EQ(code_of(cause_of(arm_with(turn_sign))), "W-CHECK-ROWS");
  EXPECT_EQ(code_of(cause_of(arm_with(push))), "W-CHECK-MOVED");
  EXPECT_EQ(code_of(cause_of(arm_with(alternate))), "W-CHECK-PATTERN");
  EXPECT_EQ(code_of(cause_of(arm_with(contradict))), "W-CHECK-CONTRADICT");
  EXPECT_EQ(code_of(cause_of(arm_with(), with_scale())), "W-CHECK-SCALE");
}

TEST(ErrorCause, OfASoundFileIsNone) {
  const ErrorCause none = cause_of(arm_with());
  EXPECT_TRUE(none.words.empty());
  EXPECT_TRUE(none.findings.empty());
  EXPECT_TRUE(none.moved.empty());
  EXPECT_FALSE(none.explains_outliers);
}

TEST(ErrorCause, InWordsPointsToItsFindings) {
  for (const SimulatedArm& at : {arm_with(turn_sign), arm_with(push), arm_with(contradict)}) {
    const ErrorCause cause = cause_of(at);
    EXPECT_TRUE(holds(cause.words, "see " + code_of(cause))) << cause.words;
  }
  EXPECT_TRUE(cause_of(arm_with(alternate)).words.empty()) << "no cause of large errors";
}

TEST(ErrorCause, SaysWhatMovedOnlyWhereSomethingMoved) {
  EXPECT_TRUE(holds(cause_of(arm_with(push)).words, cause_of(arm_with(push)).moved));
  EXPECT_FALSE(cause_of(arm_with(push)).moved.empty());
  for (const SimulatedArm& at : {arm_with(turn_sign), arm_with(alternate), arm_with(contradict)})
    EXPECT_TRUE(cause_of(at).moved.empty());
}

TEST(ErrorCause, ExplainsOutliersWhereItIsRowsOfTheirOwn) {
  EXPECT_TRUE(cause_of(arm_with(turn_sign)).explains_outliers);
  EXPECT_TRUE(cause_of(arm_with(contradict)).explains_outliers);
  EXPECT_FALSE(cause_of(arm_with(push)).explains_outliers);
  EXPECT_FALSE(cause_of(arm_with(), with_scale()).explains_outliers);
}

TEST(ErrorCause, OfSeveralIsTheFirstThatTheOthersWouldFollowFrom) {
  EXPECT_EQ(code_of(cause_of(arm_with(turn_sign), with_scale())), "W-CHECK-ROWS");
  EXPECT_EQ(code_of(cause_of(arm_with(push), with_scale())), "W-CHECK-SCALE");
  EXPECT_EQ(code_of(cause_of(arm_with(push, contradict))), "W-CHECK-MOVED");
  EXPECT_EQ(code_of(cause_of(arm_with(take_turns))), "W-CHECK-PATTERN");
}

TEST(ErrorCause, IsNotSoughtInRowsOrMovesOfFilesThatAreMeantOtherwise) {
  const Known otherwise{.otherwise_meant = true};
  EXPECT_NE(code_of(cause_of(arm_with(turn_sign), otherwise)), "W-CHECK-ROWS");
  EXPECT_NE(code_of(cause_of(arm_with(push), otherwise)), "W-CHECK-MOVED");
  EXPECT_EQ(code_of(cause_of(arm_with(contradict), otherwise)), "W-CHECK-CONTRADICT");
}

TEST(ErrorCause, IsNotToldTwiceWhereASetUpHasMoved) {
  EXPECT_NE(code_of(cause_of(arm_with(push), {.setups_moved = true})), "W-CHECK-MOVED");
  EXPECT_EQ(code_of(cause_of(arm_with(turn_sign), {.setups_moved = true})), "W-CHECK-ROWS");
}

TEST(ErrorCause, HasNoPatternWhereNothingCouldBeFitted) {
  EXPECT_EQ(code_of(cause_of(arm_with(take_turns), {.fits = false})), "W-CHECK-CONTRADICT");
}

}  // namespace
}  // namespace plumb::offline

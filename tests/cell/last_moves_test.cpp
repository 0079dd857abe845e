// SPDX-License-Identifier: Apache-2.0
#include "cell/last_moves.hpp"
#include "cell/measurement_reader.hpp"

#include <cmath>

#include "cell/measurements.hpp"
#include "cell/targets.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

const std::vector<bool> kArm{true, true};

constexpr const char* kWithColumns =
    "q1_rad,q2_rad,dir_j1,travel_j1_rad,dir_j2,travel_j2_rad,x_mm\n"
    "0,0,0,0,0,0,1\n0.4,-0.2,1,0.4,-1,0.2,1\n0.3,0.2,-1,0.1,1,0.4,1\n";
constexpr const char* kWithoutColumns = "q1_rad,q2_rad,x_mm\n0,0,1\n0.4,-0.2,1\n0.3,0.2,1\n";
constexpr const char* kShuffled =
    "q1_rad,q2_rad,dir_j1,travel_j1_rad,dir_j2,travel_j2_rad,x_mm\n"
    "0.3,0.2,-1,0.1,1,0.4,1\n0,0,0,0,0,0,1\n0.4,-0.2,1,0.4,-1,0.2,1\n";

Measurements read(const std::vector<std::string>& texts, Needs needs) {
  const Folder folder;
  std::vector<std::filesystem::path> files;
  for (const auto& text : texts)
    files.push_back(folder.put("m" + std::to_string(files.size()) + ".csv", text));
  return read_measurements(files, kArm, needs);
}

TEST(LastMoves, OfConsecutiveRowsAreTheSameFromTheColumnsAndFromTheRowsBefore) {
  const auto with = read({kWithColumns}, Needs::kJointsAndPosition).context.step;
  const auto without = read({kWithoutColumns}, Needs::kJointsAndPosition).context.step;
  ASSERT_EQ(with.rows(), 3);
  EXPECT_LT((with - without).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(with(2, 0), -0.25, 1e-12);
  EXPECT_NEAR(with(2, 1), 1.0, 1e-12);
}

TEST(LastMoves, OfAListInAnyOrderComeFromItsColumnsNotFromItsRows) {
  const auto there = read({kWithColumns}, Needs::kJointsAndPosition).context.step;
  const auto listed = read({kShuffled}, Needs::kJoints).context.step;
  const int from[] = {2, 0, 1};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(listed.row(i), there.row(from[i])) << i;
}

TEST(LastMoves, OfAListWithoutColumnsAreUnknownAndSoIsItsOrder) {
  const auto context = read({kWithoutColumns}, Needs::kJoints).context;
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isnan(context.step(i, 0)) && std::isnan(context.step(i, 1)));
    EXPECT_TRUE(std::isnan(context.order(i)));
  }
}

TEST(LastMoves, NeverReachAcrossTheBorderOfTwoFiles) {
  const auto one = read({kWithoutColumns, kWithoutColumns}, Needs::kJointsAndPosition).context;
  EXPECT_EQ(one.step.row(3), one.step.row(0));
  EXPECT_EQ(one.step.row(4), one.step.row(1));
}

TEST(LastMoves, WithColumnsInOneOfTwoFilesEachIsReadAsItIs) {
  const auto both = read({kWithColumns, kWithoutColumns}, Needs::kJoints).context.step;
  EXPECT_EQ(both(1, 0), 1.0);
  EXPECT_TRUE(std::isnan(both(4, 0)));
}

TEST(LastMoves, AJointThatMovedNobodyKnowsWhichWayIsUnknown) {
  const auto step = read({"q1_rad,q2_rad,dir_j1,travel_j1_rad,dir_j2,travel_j2_rad\n"
                          "0,0,0,0.2,1,0.4\n"},
                         Needs::kJoints)
                        .context.step;
  EXPECT_TRUE(std::isnan(step(0, 0)));
  EXPECT_EQ(step(0, 1), 1.0);
}

TEST(LastMoves, OfTargetsAreNotTakenFromTheTargetBefore) {
  const Folder folder;
  const auto t = read_targets(
      folder.put("t.csv", "x_mm,y_mm,z_mm,q1_deg,q2_deg\n1,2,3,4,5\n1,2,3,40,5\n"), kArm);
  EXPECT_TRUE(std::isnan(t.context.step(1, 0)));
}

}  // namespace
}  // namespace plumb::offline

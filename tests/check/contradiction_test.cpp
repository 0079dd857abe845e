// SPDX-License-Identifier: Apache-2.0
// A part of the readings that contradicts the rest, and what only looks like one.
#include "check/contradiction.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/check/simulated_arm.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr int kPoses = 120;
const Eigen::RowVector3d kOff_M(1.5e-3, -2.0e-3, 1.0e-3);

/// So many rows, anywhere in the file.
std::vector<int> any_rows(int count, std::uint64_t seed) {
  tests::Random random(seed);
  std::vector<int> out;
  for (int i = 0; i < kPoses; ++i) out.push_back(i);
  for (int i = 0; i < count; ++i) std::swap(out[i], out[i + random.below(kPoses - i)]);
  out.resize(static_cast<std::size_t>(count));
  return out;
}

SimulatedArm spoilt(std::uint64_t seed, const std::vector<int>& rows) {
  SimulatedArm out = simulated_arm(seed, kPoses);
  for (const int row : rows) out.measured.p_M.row(row) += kOff_M;
  return out;
}

/// The arm as it is known best: placed, not fitted, so that no reading is left out beforehand.
std::optional<Problem> contradicted(const SimulatedArm& at) {
  return contradiction(at.cell, at.measured, at.rows, place_nominal(at.cell, at.measured, at.rows));
}

TEST(Contradiction, OfAPartIsSaidWithItsShareAndItsSize) {
  for (const int count : {18, 30, 42}) {
    const auto found = contradicted(spoilt(2, any_rows(count, 7)));
    ASSERT_TRUE(found) << count;
    EXPECT_EQ(found->code, "W-CHECK-CONTRADICT");
    EXPECT_NEAR(std::atof(found->message.c_str()), 100.0 * count / kPoses, 1.0) << found->message;
    const std::string before = "the former miss it by ";
    const std::size_t at = found->message.find(before);
    ASSERT_NE(at, std::string::npos) << found->message;
    EXPECT_NEAR(std::atof(found->message.c_str() + at + before.size()), 1e3 * kOff_M.norm(),
                0.15 * 1e3 * kOff_M.norm())
        << found->message;
  }
}

TEST(Contradiction, PointsToTheFirstLineOfThatPart) {
  std::vector<int> rows = any_rows(30, 3);
  const auto found = contradicted(spoilt(1, rows));
  ASSERT_TRUE(found);
  const int first = *std::min_element(rows.begin(), rows.end());
  const SimulatedArm at = simulated_arm(1, kPoses);
  ASSERT_TRUE(found->place);
  EXPECT_EQ(found->place->line, at.measured.tables.front().lines[static_cast<std::size_t>(first)]);
}

TEST(Contradiction, IsNoneInSoundFilesNorOfAFewReadings) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_FALSE(contradicted(spoilt(seed, {}))) << seed;
    EXPECT_FALSE(contradicted(spoilt(seed, any_rows(4, seed)))) << "outliers";
  }
}

TEST(Contradiction, IsNoneWhereTheRowsFollowEachOther) {
  std::vector<int> block;
  for (int i = 50; i < 80; ++i) block.push_back(i);
  EXPECT_FALSE(contradicted(spoilt(2, block)));
}

TEST(Contradiction, IsNoneWhereAColumnTellsThePartsApart) {
  const std::vector<int> rows = any_rows(30, 5);
  SimulatedArm at = spoilt(2, rows);
  EXPECT_TRUE(contradicted(at));
  Column face;
  face.header = face.name = "face";
  face.values.assign(kPoses, 1.0);
  for (const int row : rows) face.values[static_cast<std::size_t>(row)] = 2.0;
  at.measured.tables.front().columns.push_back(face);
  EXPECT_FALSE(contradicted(at));
}

TEST(Contradiction, IsNotLookedForWhereTheFitLeavesNothingOrRowsAreFew) {
  const SimulatedArm at = spoilt(2, any_rows(30, 5));
  const ArmState placed = place_nominal(at.cell, at.measured, at.rows);
  std::vector<int> few(at.rows.begin(), at.rows.begin() + 25);
  EXPECT_FALSE(contradiction(at.cell, at.measured, few, placed));
  const SimulatedArm sound = simulated_arm(2, kPoses);
  EXPECT_FALSE(contradiction(sound.cell, sound.measured, sound.rows, fitted_state(sound)));
}

/// Of two halves no one can say which is right.
TEST(Contradiction, IsNoneOfHalfTheReadings) {
  EXPECT_FALSE(contradicted(spoilt(2, any_rows(60, 9))));
}

}  // namespace
}  // namespace plumb::offline

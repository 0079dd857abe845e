// SPDX-License-Identifier: Apache-2.0
// Which of the effects that the fitted readings chose the held-out readings refuse.
#include "diagnose/refused_steps.hpp"

#include <gtest/gtest.h>

#include "tests/diagnose/hiding.hpp"

namespace plumb::offline {
namespace {

ErrorStats error(double mean) {
  return {.n = 100, .mean = mean, .rms = 1.1 * mean, .p95 = 1.6 * mean, .max = 2.0 * mean};
}

/// Two effects, of which the first lowers the error of the points and keeps that of the
/// orientations; the second does the reverse.
Diagnosis two_added(bool turns) {
  Diagnosis out;
  out.floor.mean_m = 10e-6;
  out.before = error(40e-6);
  if (turns) {
    out.turns.emplace();
    out.turns->floor.mean_rad = 20e-6;
    out.turns->before = error(200e-6);
  }
  for (int i = 0; i < 2; ++i) {
    Addition& one = out.added.emplace_back();
    one.entry.name = i == 0 ? "drift" : "tool_sag";
    one.held = error(20e-6);
    one.turns = error(i == 0 ? 200e-6 : 400e-6);
  }
  return out;
}

TEST(StepsKept, AreAllWhileTheErrorFalls) {
  EXPECT_EQ(steps_kept(10.0, {}), 0U);
  EXPECT_EQ(steps_kept(10.0, {8.0, 6.0}), 2U);
  EXPECT_EQ(steps_kept(10.0, {11.0, 6.0}), 2U) << "a later effect brings it down again";
}

TEST(StepsKept, EndAtTheLeastErrorWhereItEndsClearlyAboveThat) {
  EXPECT_EQ(steps_kept(10.0, {6.0, 7.0}), 1U);
  EXPECT_EQ(steps_kept(10.0, {6.0, 6.2}), 2U) << "within a twentieth";
  EXPECT_EQ(steps_kept(10.0, {12.0}), 0U);
  EXPECT_EQ(steps_kept(10.0, {6.0, 20.0, 9.5}), 1U) << "it leaps";
}

TEST(StepsKept, CountOrientationsBesideThePoints) {
  EXPECT_EQ(steps_kept(two_added(false)), 2U);
  EXPECT_EQ(steps_kept(two_added(true)), 1U);
}

TEST(RisesOver, CountsOrientationsBesideThePoints) {
  const HeldOutError worse_turned{error(39e-6), error(240e-6)};
  EXPECT_FALSE(rises_over(two_added(false), worse_turned));
  EXPECT_TRUE(rises_over(two_added(true), worse_turned));
}

TEST(Refusal, SaysWhatRose) {
  const Diagnosis found = two_added(true);
  const Problem said = refusal({}, found, 1, error_after(found, 2));
  EXPECT_TRUE(says(said.message,
                   "tool_sag; the error on unseen poses, points and orientations together, rose "
                   "from 0.020 to 0.020 mm and from 0.0115 deg to 0.0229 deg"))
      << said.message;
  EXPECT_FALSE(says(refusal({}, two_added(false), 1, error_after(found, 2)).message, "deg"));
}

}  // namespace
}  // namespace plumb::offline

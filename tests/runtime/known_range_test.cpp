// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/known_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plumb/runtime/corrector.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb {
namespace {

using format::ContextInput;

/// Six joints without a tree, fitted in -1 .. 1 rad, between 0 and 4 kg and 20 and 22 degC.
format::Model arm() {
  format::Model model = tests::one_arm();
  model.trees = {};
  model.domain.q_min.assign(6, -1.0);
  model.domain.q_max.assign(6, 1.0);
  model.domain.context = {{ContextInput::kPayload, "", 0.0, 4.0},
                          {ContextInput::kTemperature, "temp", 20.0, 22.0}};
  model.effects = {{.name = "thermal_growth",
                    .joints = {0},
                    .parameters = {0.0, 0.0, 0.0},
                    .context = {{ContextInput::kTemperature, "temp", 21.0}},
                    .constants = {21.0}}};
  return model;
}

std::vector<double> at(double q3) { return {0.3, -0.6, q3, 0.5, 0.7, 0.2}; }

KnownRange::Found look(double q3, double payload_kg, double temp_degC) {
  Context context;
  context.payload_kg = payload_kg;
  context.temperature_degC[0] = temp_degC;
  return KnownRange(arm()).look(at(q3), context);
}

TEST(KnownRange, InsideTheBoxAndWhereNothingIsKnownOfTheContextIsInside) {
  for (const double q3 : {-1.0, -0.4, 0.0, 1.0}) {
    EXPECT_FALSE(look(q3, 2.0, 21.0).outside);
    EXPECT_FALSE(look(q3, kUnknown, kUnknown).outside);
    EXPECT_EQ(look(q3, 4.0, 22.0).weight, 1.0);
  }
}

TEST(KnownRange, AnyJointBeyondItsBoxIsOutsideOnEitherSide) {
  const KnownRange known(arm());
  for (std::size_t j = 0; j < 6; ++j)
    for (const double q : {-1.04, 1.04}) {
      std::vector<double> there = at(0.0);
      there[j] = q;
      EXPECT_TRUE(known.look(there, {}).outside) << j;
      EXPECT_TRUE(known.joint_outside(j, q));
    }
}

TEST(KnownRange, TheWeightHoldsOneStepThenFallsWithoutAJumpToNothing) {
  EXPECT_EQ(look(1.035 + 0.1, 1.0, 21.0).weight, 1.0);
  EXPECT_EQ(look(1.035 + 0.61, 1.0, 21.0).weight, 0.0);
  double before = 1.0;
  for (double q = 1.0; q < 1.8; q += 1e-3) {
    const double now = look(q, 1.0, 21.0).weight;
    EXPECT_LE(now, before);
    EXPECT_LT(before - now, 5e-3);
    before = now;
  }
}

TEST(KnownRange, SixHundredKilogramsForFourAndKelvinForDegreesAreFarOutside) {
  EXPECT_TRUE(look(0.0, 600.0, 21.0).outside);
  EXPECT_EQ(look(0.0, 600.0, 21.0).weight, 0.0);
  EXPECT_TRUE(look(0.0, 2.0, 294.0).outside);
  EXPECT_EQ(look(0.0, 2.0, 294.0).weight, 0.0);
}

TEST(KnownRange, AWarmDayAndATenthOfThePayloadAreNoMatter) {
  EXPECT_FALSE(look(0.0, 4.3, 26.5).outside);
  EXPECT_TRUE(look(0.0, 5.0, 21.0).outside);
  EXPECT_EQ(look(0.0, 5.0, 21.0).weight, 1.0);
  EXPECT_TRUE(look(0.0, 2.0, 30.0).outside);
  EXPECT_EQ(look(0.0, 2.0, 30.0).weight, 1.0);
}

TEST(KnownRange, AModelWithoutBoxAndRangesKnowsNoOutside) {
  format::Model model = arm();
  model.domain = {};
  Context context;
  context.payload_kg = 1e6;
  EXPECT_FALSE(KnownRange(model).look(std::vector<double>(6, 1e3), context).outside);
}

/// The command for where the true arm of the model stands at q.
Correction corrected(const format::Model& model, const std::vector<double>& q,
                     const Context& context, Transformd& X_BD) {
  const Corrector corrector(model);
  X_BD = corrector.forward_model().predict(q, context).X_BT;
  return corrector.solve(X_BD, q, SeedKind::kCommanded, context);
}

TEST(CorrectorOutside, InsideEveryBitIsThatOfAModelWithoutADomain) {
  format::Model free = arm();
  free.domain = {};
  Transformd X_BD;
  const Correction held = corrected(arm(), at(0.9), {}, X_BD);
  const Correction open = corrected(free, at(0.9), {}, X_BD);
  EXPECT_EQ(held.X_BC.p, open.X_BC.p);
  EXPECT_EQ(held.X_BC.R, open.X_BC.R);
  EXPECT_EQ(held.status, open.status);
}

TEST(CorrectorOutside, WithoutATreeTooTheStatusSaysSoAndFarOutTheCommandIsTheTarget) {
  Transformd X_BD;
  const Correction inside = corrected(arm(), at(0.5), {}, X_BD);
  const double whole = (inside.X_BC.p - X_BD.p).norm();
  EXPECT_GT(whole, 1e-4);
  const Correction near = corrected(arm(), at(1.06), {}, X_BD);
  EXPECT_EQ(near.status, Status::kOutsideDomain);
  EXPECT_GT((near.X_BC.p - X_BD.p).norm(), 1e-4);
  const Correction far = corrected(arm(), at(2.2), {}, X_BD);
  EXPECT_EQ(far.status, Status::kOutsideDomain);
  EXPECT_LT((far.X_BC.p - X_BD.p).norm(), 1e-15);
  EXPECT_LT((far.X_BC.R - X_BD.R).norm(), 1e-14);
}

TEST(CorrectorOutside, AnInputFarOutsideItsRangeLeavesTheTargetAlone) {
  Context context;
  context.temperature_degC[0] = 294.0;
  Transformd X_BD;
  const Correction kelvin = corrected(arm(), at(0.5), context, X_BD);
  EXPECT_EQ(kelvin.status, Status::kOutsideDomain);
  EXPECT_LT((kelvin.X_BC.p - X_BD.p).norm(), 1e-15);
}

TEST(CorrectorOutside, TheCorrectionNeverJumpsOnTheWayOut) {
  Transformd X_BD;
  double before = -1.0;
  for (double q = 0.9; q < 2.0; q += 2e-3) {
    const Correction c = corrected(arm(), at(q), {}, X_BD);
    ASSERT_FALSE(refused(c.status));
    const double size = (c.X_BC.p - X_BD.p).norm();
    if (before >= 0.0) {
      EXPECT_LT(std::abs(size - before), 2e-5);
    }
    before = size;
  }
}

}  // namespace
}  // namespace plumb

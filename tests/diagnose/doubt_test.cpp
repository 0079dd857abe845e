// SPDX-License-Identifier: Apache-2.0
// What imitates an effect so well that these poses cannot tell is never named with certainty: slow
// motions and steps, moves of two parts, loads of unknown weight; and a slow wave is one wave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/diagnosis.hpp"
#include "effects/registry.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/diagnose/hiding.hpp"

namespace plumb::offline {
namespace {

Diagnosis applied(const BlindCase& blind) {
  return diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
}

bool adds(const Diagnosis& d, const char* effect) {
  return std::any_of(d.added.begin(), d.added.end(),
                     [&](const Addition& added) { return added.entry.name == effect; });
}

/// The zero of a joint creeps with the temperature of its drive; no law of the library does that.
TEST(Doubt, AStepThatMayBeASlowMotionIsNotNamedForCertain) {
  int slow = 0;
  for (const char* hidden : {"warm_encoder:J2:0.6", "warm_encoder:J2:1", "warm_encoder:J4:0.8"})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const BlindCase blind = make_blind_case(hiding({hidden}, 80, seed));
      const Diagnosis d = applied(blind);
      const bool step_first =
          d.finding == Finding::kMissing && is_change_point(d.candidates.front().entry.name);
      EXPECT_FALSE(step_first) << hidden << " " << seed << ": " << d.text;
      EXPECT_FALSE(adds(d, "step")) << hidden << " " << seed << ": " << d.text_after;
      if (!d.slow_motion) continue;
      ++slow;
      EXPECT_EQ(d.finding, Finding::kUndecidable);
      EXPECT_TRUE(says(d.text, "these poses cannot tell")) << d.text;
      EXPECT_FALSE(says(d.text, "Certain")) << d.text;
    }
  EXPECT_GE(slow, 1) << "a case in which the two are near each other must occur";
}

/// The zero of a joint moves on from 30 to 60 % of the session, or jumps and settles behind that.
TEST(Doubt, WhatMovesGraduallyInAPartOfTheSeriesIsNoStep) {
  constexpr double kSize_rad = 250e-6;
  for (const bool settles : {false, true})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      BlindCase blind = make_blind_case(hiding({}, 150, seed));
      Measurements& m = blind.measured.measured;
      for (Eigen::Index i = 0; i < m.q.rows(); ++i) {
        const double behind = static_cast<double>(i) / static_cast<double>(m.q.rows()) - 0.3;
        const double moved = settles ? (behind < 0.0 ? 0.0 : std::exp(-behind / 0.15))
                                     : std::clamp(behind / 0.3, 0.0, 1.0);
        m.q(i, 3) -= kSize_rad * moved;
      }
      const Diagnosis d = applied(blind);
      EXPECT_NE(d.finding, Finding::kMissing) << seed << ": " << d.text;
      EXPECT_FALSE(adds(d, "step")) << seed << ": " << d.text_after;
    }
}

TEST(Doubt, AStepThatNoSlowMotionImitatesIsNamed) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Diagnosis d = applied(make_blind_case(hiding({"step_encoder:J3:3"}, 120, seed)));
    EXPECT_EQ(d.finding, Finding::kMissing) << d.text;
    EXPECT_FALSE(d.slow_motion) << d.text;
    EXPECT_TRUE(adds(d, "step")) << d.text_after;
  }
}

/// Several moves of the base can imitate one of the reflector.
TEST(Doubt, AMoveOfTheBaseAndOneOfTheReflectorAreOneMoveEach) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const BlindCase blind =
        make_blind_case(hiding({"step_base::5", "step_reflector::3"}, 200, seed));
    const Diagnosis d = applied(blind);
    ASSERT_EQ(d.added.size(), 2U) << seed << ": " << d.text_after;
    for (const Addition& added : d.added) {
      EXPECT_EQ(added.entry.name, "step") << seed;
      EXPECT_LE(added.moves.size(), 1U) << seed << ": " << d.text_after;
    }
    EXPECT_TRUE(d.candidates.front().moves.size() <= 1) << seed << ": " << d.text;
  }
}

/// No mass is stated, and the base tilts: whatever is added besides the yielding joint, which
/// imitates it in part, may be the base too.
TEST(Doubt, UnderUnknownWeightsEveryEffectOfThePoseMayBeTheBase) {
  int beside = 0, doubted = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    BlindRequest request = hiding({"base_compliance::8"}, 100, seed);
    request.masses = StatedMasses::kNone;
    const Diagnosis d = applied(make_blind_case(request));
    if (d.candidates.front().entry.name == "base_compliance") continue;  // rightly
    EXPECT_NE(d.finding, Finding::kMissing) << seed << ": " << d.text;
    EXPECT_NE(d.finding_after, Finding::kComplete) << seed << ": " << d.text_after;
    for (std::size_t i = 1; i < d.added.size(); ++i) {
      if (d.added[i].entry.name == "base_compliance") continue;
      ++beside;
      doubted += !d.added[i].alternatives.empty();
    }
  }
  std::printf("%d effects beside the first, %d of them doubted\n", beside, doubted);
  EXPECT_GE(4 * doubted, 3 * beside);
}

/// The joint turns by half a turn, so that three cycles a turn are one and a half waves.
TEST(Doubt, ASlowWaveIsOneWaveOfItsOwnNumber) {
  constexpr double kCycles = 3.0, kSize_rad = 150e-6;
  constexpr Eigen::Index kJoint = 2;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    BlindRequest request = hiding({}, 150, seed);
    const BlindCase first = make_blind_case(request);
    const auto q = first.measured.measured.q.col(kJoint);
    request.choice.range = std::min(1.0, M_PI / (q.maxCoeff() - q.minCoeff()));
    BlindCase blind = make_blind_case(request);
    Measurements& m = blind.measured.measured;
    for (Eigen::Index i = 0; i < m.q.rows(); ++i)
      m.q(i, kJoint) -= kSize_rad * std::sin(kCycles * m.q(i, kJoint) + static_cast<double>(seed));
    const Diagnosis d = applied(blind);
    ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
    const Candidate& best = d.candidates.front();
    EXPECT_TRUE(is_wave(best.entry.name)) << d.text;
    ASSERT_EQ(best.cycles.size(), 1U) << d.text;
    EXPECT_NEAR(best.cycles.front(), kCycles, 0.1) << d.text;
  }
}

}  // namespace
}  // namespace plumb::offline

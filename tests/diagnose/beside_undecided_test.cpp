// SPDX-License-Identifier: Apache-2.0
// What these poses cannot decide keeps nothing else out of the model, and stays out of it itself.
#include "diagnose/beside_undecided.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "arm/predicted_points.hpp"
#include "diagnose/alternatives.hpp"
#include "diagnose/certainty.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/doubt.hpp"
#include "diagnose/exchange.hpp"
#include "diagnose/model_parts.hpp"
#include "show/diagnose_view.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/hiding.hpp"
#include "tests/diagnose/true_error.hpp"

namespace plumb::offline {
namespace {

constexpr int kPushedAfter = 70;  // of 140 poses

/// In the middle of the session the hall becomes warmer, and the column leans: whether the tracker
/// was pushed or the column leans with the temperature no pose can tell.
BlindCase pushed_or_warm(const std::vector<std::string>& effects, double lean_rad,
                         std::uint64_t seed) {
  BlindRequest request = hiding(effects, 140, seed);
  request.fresh_poses = 300;
  BlindCase out = make_blind_case(request);
  Measurements& m = out.measured.measured;
  const format::Pose& X_MB = out.measured.X_MB;
  const Eigen::Quaterniond R_MB(X_MB.q[0], X_MB.q[1], X_MB.q[2], X_MB.q[3]);
  const Eigen::Vector3d lean_M = R_MB * Eigen::Vector3d(lean_rad, -0.6 * lean_rad, 0.0);
  const Eigen::Vector3d base_M(X_MB.p[0], X_MB.p[1], X_MB.p[2]);
  for (int i = 0; i < m.size(); ++i) {
    const bool after = m.context.order(i) >= kPushedAfter;
    m.context.temperature.row(i).setConstant((after ? 26.0 : 20.0) + 0.2 * std::sin(0.9 * i));
    if (!after) continue;
    const Eigen::Vector3d p_M = m.p_M.row(i).transpose();
    m.p_M.row(i) += lean_M.cross(p_M - base_M).transpose();
  }
  return out;
}

Diagnosis applied(const BlindCase& blind) {
  return diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
}

std::vector<std::string> keys_of_added(const BlindCase& blind, const Diagnosis& d) {
  std::vector<std::string> out;
  for (const Addition& added : d.added) out.push_back(key_of(blind.cell, added.entry));
  std::sort(out.begin(), out.end());
  return out;
}

const std::vector<std::string> kYieldsAndReverses{"joint_compliance:J2", "reversal:J3"};

TEST(BesideUndecided, WhatElseIsSupportedIsAddedAndTheUndecidedStaysOut) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const BlindCase blind = pushed_or_warm({"joint_compliance:J2:2", "reversal:J3:2"}, 60e-6, seed);
    const Diagnosis d = applied(blind);
    ASSERT_FALSE(d.candidates.empty());
    EXPECT_TRUE(of_different_fate(d.candidates.front().entry, d.alternatives))
        << "the search begins with what it cannot decide: " << d.text;

    EXPECT_EQ(keys_of_added(blind, d), kYieldsAndReverses);
    EXPECT_EQ(d.effects.size(), blind.cell.effects.size() + kYieldsAndReverses.size());
    for (const EffectEntry& entry : d.effects)
      EXPECT_TRUE(entry.name != "step" && entry.name != "thermal_growth") << "it is written";

    ASSERT_TRUE(d.undecided.has_value()) << d.text_after;
    EXPECT_TRUE(of_different_fate(d.undecided->entry, d.undecided->alternatives));
    EXPECT_EQ(certainty(blind.cell, d), Certainty::kAOrB);
    EXPECT_EQ(show::diagnose_json(blind.cell, d).count("not_added"), 1U);
    EXPECT_TRUE(says(d.text_after, "2 effects added: held-out error")) << d.text_after;
    EXPECT_TRUE(says(d.text_after, "these poses cannot tell")) << d.text_after;
    EXPECT_FALSE(says(d.text_after, "Nothing was added")) << d.text_after;

    EXPECT_LT(d.after.mean, d.before.mean);
    EXPECT_LT(true_error_of(blind, d.effects), 0.7 * true_error_of(blind, blind.cell.effects));
  }
}

TEST(BesideUndecided, WhereNothingElseIsSupportedNothingIsAdded) {
  const BlindCase blind = pushed_or_warm({}, 60e-6, 1);
  const Diagnosis d = applied(blind);
  EXPECT_TRUE(d.added.empty()) << d.text_after;
  ASSERT_TRUE(d.undecided.has_value()) << d.text_after;
  EXPECT_TRUE(says(d.text_after, "Nothing was added; ")) << d.text_after;
}

/// Beside what the arm does the jump fits a push better than the temperature by far.
TEST(BesideUndecided, WhatTheOthersDecideIsAddedAsUsual) {
  const BlindCase blind = pushed_or_warm({"joint_compliance:J2:3", "reversal:J3:3"}, 150e-6, 2);
  const Diagnosis d = applied(blind);
  ASSERT_FALSE(d.candidates.empty());
  EXPECT_TRUE(of_different_fate(d.candidates.front().entry, d.alternatives)) << d.text;
  EXPECT_FALSE(d.undecided.has_value()) << d.text_after;
  auto keys = kYieldsAndReverses;
  keys.emplace_back("step/base");
  EXPECT_EQ(keys_of_added(blind, d), keys) << d.text_after;
}

/// Two joints have uneven gears, of which one must stay undecided.
TEST(BesideUndecided, ANuisanceIsFittedButNeitherAddedNorExchangedNorTakenOut) {
  BlindCase blind = healthy_arm(80);
  make_uneven(blind, 1, 3e-4);
  make_uneven(blind, 3, 3e-4);
  Selection s = begun(blind);
  Found nuisance;
  nuisance.entry = {.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}};
  const double left = s.whitened().Q;
  s.leave_open({nuisance.entry});
  s.carry(nuisance);
  EXPECT_LT(s.whitened().Q, left) << "it is fitted";
  EXPECT_TRUE(s.added.empty());
  EXPECT_EQ(s.carried().size(), 1U);
  EXPECT_TRUE(keys_in(s).empty()) << "as if the cell stated it";
  EXPECT_TRUE(s.is_open(nuisance.entry));
  EXPECT_FALSE(s.is_open({.name = "gear_harmonics", .joints = {3}, .options = {}, .place = {}}));
  EXPECT_TRUE(kExchange.subjects(s).empty());
  EXPECT_TRUE(kDoubt.subjects(s).empty());
  EXPECT_FALSE(
      lost(s.cell(), s.whitened(), s.calibration(), s.start().cell.effects, {}).has_value());
}

/// What imitates the open finding is not exchanged for it.
TEST(BesideUndecided, NoRevisionPutsAnOpenFindingIntoTheModel) {
  BlindCase blind = healthy_arm(80);
  make_uneven(blind, 1, 3e-4);
  make_uneven(blind, 3, 3e-4);
  const EffectEntry open{.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}};
  const EffectEntry other{.name = "gear_harmonics", .joints = {3}, .options = {}, .place = {}};
  const EffectEntry imitates{.name = "joint_compliance", .joints = {1}, .options = {}, .place = {}};
  Selection s = having_added(blind, {imitates, other});
  const auto before = keys_in(s);
  s.leave_open({open});
  EXPECT_FALSE(revise(s, kExchange));
  EXPECT_FALSE(revise(s, kDoubt));
  EXPECT_EQ(keys_in(s), before);
}

}  // namespace
}  // namespace plumb::offline

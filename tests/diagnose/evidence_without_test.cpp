// SPDX-License-Identifier: Apache-2.0
#include "diagnose/evidence_without.hpp"

#include <gtest/gtest.h>

#include "diagnose/change_points.hpp"
#include "diagnose/evidence_scale.hpp"
#include "effects/effect_option.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// A model without the harmonics of J2, which the poses show.
struct EvidenceWithout : testing::Test {
  EvidenceWithout() {
    const Regressor gear = library_regressor(arm, found.entry);
    without.model.cell = std::make_shared<const Cell>(whitened_arm().blind.cell);
    without.whitened = leaving(arm, noise_of(arm, 21) + motion_of_size(arm, gear, 1.0));
  }
  Found listed(EffectEntry entry, double ln_bayes) const {
    Found out{std::move(entry), {}, {}, {}, 0.0, {}, 0.0};
    out.scored.evidence.ln_bayes = ln_bayes;
    return out;
  }
  static Found moves(const std::vector<double>& after_rows) {
    Found out{entry_of("step"), {}, {}, {}, 0.0, {}, 0.0};
    set_option(out.entry, OptionKey::kOf, std::string("tool"));
    set_option(out.entry, OptionKey::kAfterRow, after_rows.front());
    for (const double row : after_rows) out.moves.push_back({row, 1e-4});
    return out;
  }

  const WhitenedFit& arm = whitened_arm().whitened;
  Found found{entry_of("gear_harmonics", {1}), {}, {}, {}, 0.0, {}, 0.0};
  JudgedModel without;
};

TEST_F(EvidenceWithout, AsItIsIsThatOfItsColumns) {
  const double expected = Scorer(without.whitened)
                              .score(library_regressor(without.whitened, found.entry))
                              .evidence.ln_bayes;
  EXPECT_GT(expected, 10.0);
  EXPECT_EQ(evidence_as_it_is(without, found), expected);
}

TEST_F(EvidenceWithout, OfALaterMoveIsLessByWhatItsPlaceCosts) {
  const Found two = moves({30.0, 60.0});
  const double plain = Scorer(without.whitened)
                           .score(moves_regressor(without.whitened, two.entry, {30.0, 60.0}))
                           .evidence.ln_bayes;
  const double places = static_cast<double>(without.whitened.fit_poses());
  EXPECT_LT(evidence_as_it_is(without, two), plain - 0.5 * std::log(places));
  EXPECT_GT(evidence_as_it_is(without, two), plain - 5.0 - 2.0 * std::log(places));
}

TEST_F(EvidenceWithout, WhatTheScanListsInItsPlaceCountsIfItIsMore) {
  const double own = evidence_as_it_is(without, found);
  EXPECT_EQ(evidence_without(without, found), own) << "the scan lists nothing";
  for (const double more : {-30.0, -1.0, 0.0, 1.0, 30.0}) {
    without.look.library = {listed(found.entry, own + more)};
    EXPECT_DOUBLE_EQ(evidence_without(without, found), own + std::max(0.0, more));
  }
}

TEST_F(EvidenceWithout, WhatIsListedOfAnotherEffectOrJointDoesNotCount) {
  const double own = evidence_as_it_is(without, found);
  without.look.library = {listed(entry_of("gear_harmonics", {2}), own + 50.0),
                          listed(entry_of("joint_compliance", {1}), own + 40.0),
                          listed(entry_of("gear_harmonics", {1, 2}), own + 30.0)};
  EXPECT_EQ(evidence_without(without, found), own);
}

TEST_F(EvidenceWithout, ScatterThatExplainsAsMuchIsTakenOff) {
  const double own = evidence_as_it_is(without, found);
  without.whitened.scatter_nats = 7.0;
  EXPECT_NEAR(evidence_as_it_is(without, found), own - 7.0, 1e-9);
}

/// Lines less the rank of the model are independent.
TEST_F(EvidenceWithout, IsMeasuredByTheLinesThatTheModelLeavesFree) {
  const EvidenceScale scale = evidence_scale(without.whitened);
  EXPECT_EQ(scale.lines, static_cast<double>(arm.fit_lines - arm.rank));
  EXPECT_EQ(scale.variance, arm.noise.variance);
  EXPECT_EQ(scale.dof, arm.noise.dof);
}

}  // namespace
}  // namespace plumb::offline

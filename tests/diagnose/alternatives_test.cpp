// SPDX-License-Identifier: Apache-2.0
// What these poses cannot tell apart is said as "A or B", everywhere in the same way.
#include "diagnose/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnose/candidates.hpp"
#include "diagnose/confounding.hpp"
#include "diagnose/diagnosis_text.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/excluded_laws.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/diagnose/hiding.hpp"

namespace plumb::offline {
namespace {

/// A calibrated arm and the whitened fit of all its poses.
struct Looked {
  BlindCase blind;
  std::vector<int> rows;
  Calibration calibration;
  WhitenedFit whitened;
  explicit Looked(const BlindRequest& request) : blind(make_blind_case(request)) {
    const Measurements& m = blind.measured.measured;
    rows.resize(static_cast<std::size_t>(m.size()));
    std::iota(rows.begin(), rows.end(), 0);
    calibration = calibrate(blind.cell, m, rows);
    whitened = make_whitened_fit(blind.cell, m, calibration,
                                 without_outliers(rows, calibration.outliers), {});
  }
  Looked(const Looked&) = delete;
};

Cell three_joints() {
  Cell cell;
  cell.nominal.joints.resize(3);
  for (int i = 0; i < 3; ++i) cell.nominal.joints[i].name = "J" + std::to_string(i + 1);
  return cell;
}

Diagnosis found_with(std::vector<Alternative> others) {
  Diagnosis d;
  d.finding = names_what_is_not_shown(others) ? Finding::kUndecidable : Finding::kMissing;
  d.before.mean = 61e-6;
  Candidate best;
  best.entry = {.name = "joint_compliance", .joints = {1}, .options = {}, .place = {}};
  best.ln_bayes = 437.0;
  best.alone.mean = 31e-6;
  d.candidates = {best};
  d.alternatives = std::move(others);
  return d;
}

Alternative harmonics() {
  Alternative out;
  out.entry = {.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}};
  out.domain = "robot";
  out.behind_nats = 4.0;
  return out;
}

TEST(Alternatives, AreNamedInOneSentenceWithWhatTellsThem) {
  const Cell cell = three_joints();
  const std::string text = verdict_text(cell, found_with({harmonics()}));
  EXPECT_EQ(
      text,
      "Missing: J2 yields under load, or the error of J2 repeats once and twice a turn: these "
      "poses cannot tell. Adding the first: 0.061 -> 0.031 mm on unseen poses, noise floor "
      "unknown. To tell them apart: the same poses with and without payload (plumb plan "
      "--separate joint_compliance:J2,gear_harmonics:J2).");
  EXPECT_TRUE(says(verdict_text(cell, found_with({})), "Certain.")) << "nothing is near";
}

TEST(Alternatives, ALawThatThesePosesCannotShowIsSaidWithWhatToMeasure) {
  const Cell cell = three_joints();
  Alternative hidden = harmonics();
  hidden.not_shown = "36 poses";
  hidden.measure = "40 poses or more";
  const std::string text = verdict_text(cell, found_with({hidden}));
  EXPECT_TRUE(
      says(text, "Undecidable: J2 yields under load, or a law that these poses cannot show"))
      << text;
  EXPECT_TRUE(says(text, "(36 poses): these poses cannot tell")) << text;
  EXPECT_TRUE(says(text, "40 poses or more")) << text;
  EXPECT_FALSE(says(text, "Certain")) << text;
}

TEST(Alternatives, OfDifferentFateAreNotAddedAndTheSentenceSaysWhy) {
  const Cell cell = three_joints();
  Alternative drift;
  drift.entry = {.name = "drift", .joints = {}, .options = {}, .place = {}};
  drift.compiled = is_compiled(drift.entry);
  EXPECT_FALSE(drift.compiled);
  Diagnosis d = found_with({drift});
  EXPECT_TRUE(of_different_fate(d.candidates.front().entry, d.alternatives));
  EXPECT_FALSE(of_different_fate(d.candidates.front().entry, {harmonics()}));
  d.finding_after = Finding::kUndecidable;
  d.undecided = Undecided{d.candidates.front().entry, {}, "robot", d.alternatives};
  const std::string text = verdict_after_text(cell, d);
  EXPECT_TRUE(says(text,
                   "Nothing was added; joint compliance (joint_compliance:J2) is supported, but it "
                   "may be drift"))
      << text;
  EXPECT_TRUE(says(text, "these poses cannot tell")) << text;
}

/// The words, the list and the numbers agree, whatever is hidden.
TEST(Alternatives, AreNearInEvidenceConfoundedAndNeverCertain) {
  int undecided = 0, decided = 0;
  for (const char* hidden :
       {"gear_harmonics:J2:0.5", "gravity_compensator:J2:0.6", "joint_compliance:J2:0.5",
        "joint_compliance:J3:5", "encoder_scale:J4:0.6", "base_compliance::0.7"}) {
    const BlindCase blind = make_blind_case(hiding({hidden}, 60, 3));
    const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {});
    if (d.candidates.empty() || !d.candidates.front().supported) continue;
    const bool either = !d.alternatives.empty();
    EXPECT_EQ(says(d.text, "these poses cannot tell"), either) << d.text;
    EXPECT_FALSE(either && (says(d.text, "Certain") || says(d.text, "ikely"))) << d.text;
    const EffectEntry& first = d.candidates.front().entry;
    for (const auto& other : d.alternatives) {
      EXPECT_LT(other.behind_nats, 10.0) << d.text;
      EXPECT_FALSE(other.entry.name == first.name && other.entry.joints == first.joints) << d.text;
    }
    (either ? undecided : decided) += 1;
  }
  EXPECT_GE(undecided, 1) << "a case of each kind must occur";
  EXPECT_GE(decided, 1) << "a case of each kind must occur";
}

TEST(Alternatives, OfOneCauseAreOneFinding) {
  const Looked at(hiding({"joint_compliance:J2:5"}, 150));
  const Scan look = scan(at.whitened, {}, {});
  const Found* first = look.supported();
  ASSERT_NE(first, nullptr);
  for (const auto& other : alternatives(at.whitened, look, *first, {}))
    for (const char* finer : {"joint_compliance", "gravity_free", "joint_compliance_soft"})
      EXPECT_FALSE(other.entry.name == finer && other.entry.joints == first->entry.joints);
}

TEST(Alternatives, AWaveThatSoFewPosesCannotShowIsWeighedSilently) {
  const Looked at(hiding({"gear_ripple:J2:5@cycles=9"}, 36, 4));
  const std::vector<Found> laws = excluded_laws(at.whitened, {"gear_ripple", "reversal"});
  ASSERT_FALSE(laws.empty());
  EXPECT_EQ(laws.front().entry.name, "gear_ripple");
  EXPECT_EQ(laws.front().entry.joints, std::vector<int>{1});
}

/// Where no mass is stated, only the payload's weight is known to the laws of links and base.
BlindRequest weightless(const char* effect, int poses, std::uint64_t seed) {
  BlindRequest out = hiding({effect}, poses, seed);
  out.masses = StatedMasses::kNone;
  return out;
}

bool names(const Diagnosis& d, const std::string& law) {
  return d.candidates.front().entry.name == law ||
         std::any_of(d.alternatives.begin(), d.alternatives.end(),
                     [&](const Alternative& other) { return other.entry.name == law; });
}

TEST(UnknownWeights, ALinkThatBendsOrABaseThatTiltsIsNotCalledAYieldingJoint) {
  for (const char* law : {"link_flexure", "base_compliance"})
    for (const int poses : {80, 300})
      for (const std::uint64_t seed : {1U, 2U}) {
        const std::string hidden = std::string(law) + (law[0] == 'l' ? ":J2:5" : "::5");
        const BlindCase blind = make_blind_case(weightless(hidden.c_str(), poses, seed));
        const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {});
        ASSERT_FALSE(d.candidates.empty());
        EXPECT_TRUE(names(d, law)) << hidden << ", " << poses << " poses: " << d.text;
        if (d.candidates.front().entry.name == law) continue;
        EXPECT_EQ(d.finding, Finding::kUndecidable) << d.text;
        EXPECT_TRUE(says(d.text, "no mass of a link is stated")) << d.text;
        EXPECT_FALSE(says(d.text, "Certain")) << d.text;
      }
}

TEST(UnknownWeights, ManyPosesOftenTellAJointFromALink) {
  int decided = 0, all = 0;
  for (const char* hidden : {"joint_compliance:J2:5", "joint_compliance:J3:5"})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const BlindCase blind = make_blind_case(weightless(hidden, 500, seed));
      const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {});
      EXPECT_EQ(d.candidates.front().entry.joints, std::vector<int>{hidden[18] - '1'}) << d.text;
      ++all;
      decided += d.finding == Finding::kMissing && d.alternatives.empty();
    }
  EXPECT_GE(2 * decided, all) << "a doubt that is always there says nothing";
}

TEST(UnknownWeights, AreNoDoubtWhereMassesAreStated) {
  const BlindCase blind = make_blind_case(hiding({"joint_compliance:J2:5"}, 80));
  const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {});
  EXPECT_FALSE(says(d.text, "no mass of a link is stated")) << d.text;
}

TEST(Sizes, OfACandidateAreThoseOfARefit) {
  for (const char* hidden : {"encoder_scale:J5:3", "gear_harmonics:J2:5", "joint_compliance:J3:5",
                             "tracker::5", "axis_wobble:J1:3"}) {
    const Looked at(hiding({hidden}, 200));
    const auto all = candidates_of(at.whitened, at.whitened, scan(at.whitened, {}, {}));
    ASSERT_FALSE(all.empty());
    Cell with = at.blind.cell;
    const Candidate& first = all.front();
    if (!first.cycles.empty()) continue;
    with.effects = with_effect(with.effects, first.entry);
    const Calibration refit = calibrate(with, at.blind.measured.measured, at.rows);
    int compared = 0;
    for (const auto& number : first.numbers)
      for (const auto& estimate : refit.estimates) {
        if (estimate.name != number.name) continue;
        ++compared;
        EXPECT_NEAR(number.value, estimate.value, std::max(number.std, estimate.std))
            << hidden << " " << number.name;
      }
    EXPECT_GT(compared, 0) << hidden;
  }
}

TEST(JointGroups, JointsThatYieldTogetherAreNoBentLink) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Looked at(hiding(
        {"joint_compliance:J2:5", "joint_compliance:J3:1.5", "joint_compliance:J5:1"}, 150, seed));
    const Scan look = scan(at.whitened, {}, {});
    const Found* first = look.supported();
    ASSERT_NE(first, nullptr);
    EXPECT_TRUE(grows_with_load(descriptor_of(first->entry.name)) &&
                first->entry.name != "link_flexure")
        << key_of(at.blind.cell, first->entry);
  }
}

TEST(FastWaves, OfTheMotorAreTriedWhereverTheGearRatioIsKnown) {
  BlindCase blind = make_blind_case(hiding({}, 100));
  blind.cell.mechanics[2].gear_ratio = 121.0;
  const Measurements& m = blind.measured.measured;
  std::vector<int> rows(static_cast<std::size_t>(m.size()));
  std::iota(rows.begin(), rows.end(), 0);
  const Calibration calibration = calibrate(blind.cell, m, rows);
  const WhitenedFit whitened = make_whitened_fit(blind.cell, m, calibration, rows, {});
  const auto has = [&](int joint, double wave) {
    const auto grid = ripple_grid(whitened, joint);
    return std::find(grid.begin(), grid.end(), wave) != grid.end();
  };
  EXPECT_TRUE(has(2, 121.0));
  EXPECT_TRUE(has(2, 242.0));
  EXPECT_FALSE(has(1, 121.0));
}

}  // namespace
}  // namespace plumb::offline

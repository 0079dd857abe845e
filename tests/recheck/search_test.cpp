// SPDX-License-Identifier: Apache-2.0
#include "recheck/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "recheck/constants.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kSigma_m = 2e-5;

/// Usually ten readings, and all changes but the base.
struct RecheckSearch : testing::Test {
  void measure(const ArmState& now, std::uint64_t seed, int poses = 10) {
    Measurements rows = arm.poses(poses, seed);
    rows.p_M = predict_points(now, rows);
    tests::Random random(seed);
    add_noise(rows, kSigma_m, random);
    readings = readings_of(std::move(rows), kSigma_m);
  }
  ArmState with_offset(int joint, double angle) const {
    return moved(arm.state, arm.offset(joint).parameters, Eigen::VectorXd::Constant(1, angle));
  }
  std::vector<Change> found(std::vector<Change> some, std::vector<Change> assumed = {}) const {
    const Judge judge(readings, arm.state, known);
    Search search(judge, readings, std::move(some), std::move(assumed));
    search.run();
    return search.found();
  }
  static bool has(const std::vector<Change>& all, const Change& change) {
    return std::any_of(all.begin(), all.end(), [&](const Change& c) { return same(c, change); });
  }

  SmallArm arm;
  KnownNumbers known = arm.known(1e-5);
  std::vector<Change> possible = {arm.tool(), arm.offset(0), arm.offset(1), arm.offset(2)};
  Readings readings;
};

TEST_F(RecheckSearch, FindsWhatChangedInEveryOrderOfThePossibleChanges) {
  ArmState now = with_offset(1, 6e-4);
  now.X_TG.p[2] += 5e-4;
  measure(now, 71);
  std::vector<int> order = {0, 1, 2, 3};
  do {
    std::vector<Change> listed;
    for (const int i : order) listed.push_back(possible[static_cast<std::size_t>(i)]);
    const std::vector<Change> changes = found(listed);
    EXPECT_EQ(changes.size(), 2U);
    EXPECT_TRUE(has(changes, arm.tool()));
    EXPECT_TRUE(has(changes, arm.offset(1)));
  } while (std::next_permutation(order.begin(), order.end()));
}

/// By Markov's inequality in one of fifty at most; of 200 that is 4, and 12 are a miracle.
TEST_F(RecheckSearch, NoiseIsHardlyEverTakenForAChange) {
  int alarms = 0;
  for (std::uint64_t seed = 100; seed < 300; ++seed) {
    measure(arm.state, seed);
    if (!found(possible).empty()) ++alarms;
  }
  EXPECT_LE(alarms, 11);
}

/// A belief in one change is a share of the beliefs in all: listing it twice, at half the chance
/// each, is one that is decided alike.
TEST_F(RecheckSearch, TheChancesOfAllChangesCountTogether) {
  const double chance = kFalseAlarm * 8.0;  // times a factor of about e^2
  Change small = arm.tool();
  for (double shift = 2e-5; shift < 4e-4; shift += 1e-5) {
    ArmState now = arm.state;
    now.X_TG.p[0] += shift;
    measure(now, 81);
    small.chance = chance;
    Change half = small, other = small;
    half.chance = other.chance = 0.5 * chance;
    other.joint = 7;
    EXPECT_EQ(found({small}).empty(), found({half, other}).empty()) << shift;
  }
}

/// What nobody expects needs so much more of the evidence: its chance times the Bayes factor.
TEST_F(RecheckSearch, AChangeIsFoundWhereItsChanceTimesItsBayesFactorIsFifty) {
  ArmState now = arm.state;
  now.X_TG.p[0] += 1e-4;
  measure(now, 82);
  const Judge judge(readings, arm.state, known);
  Change tool = arm.tool();
  const double bayes = std::exp(judge.judge({tool}).ln_evidence - judge.judge({}).ln_evidence);
  for (const double times : {0.9, 1.1}) {
    tool.chance = times / (kFalseAlarm * bayes);
    EXPECT_EQ(found({tool}).empty(), times < 1.0);
  }
}

/// Beside a sure change, one that two ways explain is needed by both together and by neither alone:
/// it is added and dropped, and the search ends.
TEST_F(RecheckSearch, WhatIsNeededOnlyByAllOfItsKindTogetherIsDroppedAndTheSearchEnds) {
  ArmState now = with_offset(1, 3e-3);
  now.X_TG.p[0] += 1e-4;
  measure(now, 83);
  const Judge judge(readings, arm.state, known);
  Change half = arm.tool(), other = arm.tool();
  const double bayes = std::exp(judge.judge({arm.offset(1), half}).ln_evidence -
                                judge.judge({arm.offset(1)}).ln_evidence);
  half.chance = other.chance = 0.6 / (kFalseAlarm * bayes);
  other.joint = 7;
  const std::vector<Change> changes = found({arm.offset(1), half, other});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(same(changes[0], arm.offset(1)));
}

TEST_F(RecheckSearch, ASingleWrongReadingIsFoundAndIsNoChange) {
  measure(arm.state, 91);
  readings.rows.p_M(6, 0) += 2e-3;
  const std::vector<Change> changes = found(possible);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].part, Part::kReading);
  EXPECT_EQ(changes[0].row, 6);
}

TEST_F(RecheckSearch, WithThreePosesNoReadingIsHeldForWrong) {
  measure(arm.state, 92);
  readings.rows.p_M(6, 0) += 2e-3;
  readings.poses = 3;
  for (const Change& change : found(possible)) EXPECT_NE(change.part, Part::kReading);
}

/// So few that the share of wrong readings would allow none.
TEST_F(RecheckSearch, OneOfFourReadingsMayBeWrong) {
  for (std::uint64_t seed = 500; seed < 510; ++seed) {
    measure(arm.state, seed, kFewestForOddOnes);
    readings.rows.p_M(2, 0) += 2e-3;
    const std::vector<Change> changes = found({arm.offset(0), arm.offset(1)});
    ASSERT_EQ(changes.size(), 1U) << seed;
    EXPECT_EQ(changes[0].row, 2) << seed;
  }
}

/// More are no accident, by whichever way they would come into the set: another change that
/// imitates one of them is not exchanged for it.
TEST_F(RecheckSearch, NoMoreReadingsThanThatAreHeldForWrong) {
  for (std::uint64_t seed = 520; seed < 530; ++seed)
    for (const int poses : {4, 5})
      for (const double size : {1e-3, 5e-3}) {
        measure(arm.state, seed, poses);
        for (int row = 0; row < 2; ++row) readings.rows.p_M(row, row) += size;
        const std::vector<Change> changes = found(possible);
        const auto odd = std::count_if(changes.begin(), changes.end(), [](const Change& change) {
          return change.part == Part::kReading;
        });
        EXPECT_LE(odd, 1) << seed << " " << poses << " " << size;
      }
}

/// At few poses another tool imitates the offset of a joint at first.
TEST_F(RecheckSearch, NoOtherPairIsLikelierThanThePairThatWasFound) {
  int pairs = 0;
  for (std::uint64_t seed = 600; seed < 640; ++seed) {
    tests::Random random(seed);
    ArmState now = with_offset(0, random.uniform(4e-4, 9e-4));
    now = moved(now, arm.offset(2).parameters,
                Eigen::VectorXd::Constant(1, random.uniform(-9e-4, 9e-4)));
    measure(now, seed, 6);
    const Judge judge(readings, arm.state, known);
    Search search(judge, readings, possible, {});
    search.run();
    if (search.found().size() != 2) continue;
    ++pairs;
    const auto likely = [&](const Change& a, const Change& b) {
      return judge.judge({a, b}).ln_evidence + std::log(a.chance * b.chance);
    };
    const double own = likely(search.found()[0], search.found()[1]);
    for (std::size_t i = 0; i < possible.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_LE(likely(possible[i], possible[k]), own + 1e-9) << seed << " " << i << " " << k;
  }
  EXPECT_GE(pairs, 30);
}

TEST_F(RecheckSearch, WhatIsAssumedIsKeptThoughNothingHasMoved) {
  measure(arm.state, 93);
  const std::vector<Change> changes = found({arm.offset(0), arm.offset(1)}, {arm.tool()});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(same(changes[0], arm.tool()));
}

/// No exchange of a change that was found, and none less of them, is likelier.
TEST_F(RecheckSearch, NothingNextToWhatWasFoundIsLikelier) {
  for (std::uint64_t seed = 400; seed < 412; ++seed) {
    ArmState now = with_offset(static_cast<int>(seed % 3), 2e-4);
    now.X_TG.p[seed % 3] += 3e-4;
    measure(now, seed);
    const Judge judge(readings, arm.state, known);
    Search search(judge, readings, possible, {});
    search.run();
    ASSERT_FALSE(search.found().empty());
    for (std::size_t k = 0; k < search.found().size(); ++k)
      for (const Change& change : possible) {
        if (search.holds(change)) continue;
        std::vector<Change> other = search.found();
        other[k] = change;
        EXPECT_LE(judge.judge(other).ln_evidence + std::log(change.chance),
                  search.last().ln_evidence + std::log(search.found()[k].chance));
      }
  }
}

}  // namespace
}  // namespace plumb::offline::recheck

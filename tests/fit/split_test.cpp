// SPDX-License-Identifier: Apache-2.0
#include "fit/split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "cell/random.hpp"

namespace plumb::offline {
namespace {

/// `groups` random poses, every third of them measured three times.
Measurements random_poses(int groups, std::uint64_t seed) {
  Random random(seed);
  Measurements m;
  std::vector<std::array<double, 2>> q;
  for (int g = 0; g < groups; ++g) {
    const std::array<double, 2> at{random.unit(), random.unit()};
    for (int k = 0; k < (g % 3 == 0 ? 3 : 1); ++k) {
      q.push_back(at);
      m.replicate_group.push_back(g);
    }
  }
  const int n = static_cast<int>(q.size());
  m.q.resize(n, 2);
  for (int i = 0; i < n; ++i) m.q.row(i) << q[i][0], q[i][1];
  m.p_M = Rows3::Zero(n, 3);
  m.set.assign(n, SetMark::kUnmarked);
  m.pose.assign(n, "p");
  return m;
}

HeldOutRule share(double value) { return {.kind = HeldOutRule::Kind::kShare, .share = value}; }
HeldOutRule folds(int count) { return {.kind = HeldOutRule::Kind::kFolds, .folds = count}; }

TEST(Split, NeverSeparatesReplicates) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Measurements m = random_poses(100, seed);
    const Split one = split_poses(m, share(0.2), seed), many = split_poses(m, folds(5), seed);
    for (int i = 1; i < m.size(); ++i) {
      if (m.replicate_group[i] != m.replicate_group[i - 1]) continue;
      EXPECT_EQ(one.held[i], one.held[i - 1]);
      EXPECT_EQ(many.fold[i], many.fold[i - 1]);
    }
  }
}

TEST(Split, HoldsTheShareAskedForCountedInDifferentPoses) {
  for (double wanted : {0.1, 0.2, 0.3, 0.5}) {
    const Measurements m = random_poses(200, 4);
    const Split split = split_poses(m, share(wanted), 1);
    std::set<int> held;
    for (int i : held_rows(split)) held.insert(m.replicate_group[i]);
    EXPECT_EQ(static_cast<int>(held.size()), static_cast<int>(std::lround(200 * wanted)));
  }
}

TEST(Split, EveryPoseIsHeldOutOnceAndNeverInItsOwnFit) {
  const Measurements m = random_poses(53, 2);
  const Split split = split_poses(m, folds(5), 3);
  std::vector<int> times(m.size(), 0);
  for (int k = 0; k < 5; ++k) {
    const auto fit = fit_rows(split, k), held = held_rows(split, k);
    EXPECT_EQ(fit.size() + held.size(), static_cast<std::size_t>(m.size()));
    for (int i : held) ++times[i];
    for (int i : fit) EXPECT_NE(split.fold[i], k);
  }
  for (int t : times) EXPECT_EQ(t, 1);
}

TEST(Split, AutoMeansFiveFoldsOfUpToFiveHundredPosesAndAFifthOfMore) {
  for (const int groups : {20, 59, 60, 500}) {
    const Measurements m = random_poses(groups, 1);  // readings: more than poses
    const Split split = split_poses(m, {}, 1);
    EXPECT_EQ(split.folds, 5);
    EXPECT_EQ(fit_rows(split).size(), static_cast<std::size_t>(m.size()));
    EXPECT_EQ(held_rows(split).size(), static_cast<std::size_t>(m.size()));
  }
  const Split split = split_poses(random_poses(501, 1), {}, 1);
  EXPECT_EQ(split.folds, 0);
  EXPECT_GT(held_rows(split).size(), 100u);
}

TEST(Split, SameSeedSamePosesOtherSeedOtherPoses) {
  const Measurements m = random_poses(100, 9);
  EXPECT_EQ(split_poses(m, share(0.2), 1).held, split_poses(m, share(0.2), 1).held);
  EXPECT_NE(split_poses(m, share(0.2), 1).held, split_poses(m, share(0.2), 2).held);
}

TEST(Split, HeldOutPosesAreSpreadOverJointSpaceMoreEvenlyThanByChance) {
  // Quarters of the unit square: a stratified fifth of 400 puts close to 20 in each.
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Measurements m = random_poses(400, seed);
    std::array<std::set<int>, 4> held, all;
    const Split split = split_poses(m, share(0.2), seed);
    for (int i = 0; i < m.size(); ++i) {
      const int quarter = (m.q(i, 0) > 0.5 ? 1 : 0) + (m.q(i, 1) > 0.5 ? 2 : 0);
      all[quarter].insert(m.replicate_group[i]);
      if (split.held[i]) held[quarter].insert(m.replicate_group[i]);
    }
    for (int k = 0; k < 4; ++k)
      squares +=
          std::pow(static_cast<double>(held[k].size()) - 0.2 * static_cast<double>(all[k].size()),
                   2) /
          80.0;
  }
  // Simple random sampling gives a variance of about 0.2 * 0.8 * 100 = 16.
  EXPECT_LT(squares, 4.0);
}

TEST(Split, IgnoredRowsAreNeitherFittedNorHeld) {
  Measurements m = random_poses(100, 5);
  for (int i = 0; i < 30; ++i) m.set[i] = SetMark::kIgnore;
  const Split split = split_poses(m, share(0.2), 1);
  for (int i : fit_rows(split)) EXPECT_GE(i, 30);
  for (int i : held_rows(split)) EXPECT_GE(i, 30);
}

TEST(Split, AutoTakesTheRowsThatAreMarkedAsHeldAndNoOthers) {
  for (const int groups : {30, 100}) {
    Measurements m = random_poses(groups, 5);
    std::set<int> marked;
    for (int i = 0; i < m.size(); ++i)
      if (m.replicate_group[i] % 7 == 0) {
        m.set[i] = SetMark::kHeld;
        marked.insert(i);
      }
    const Split split = split_poses(m, {}, 1);
    const auto held = held_rows(split);
    EXPECT_EQ(std::set<int>(held.begin(), held.end()), marked);
    EXPECT_EQ(split.folds, 0);
    EXPECT_TRUE(split.marked);
    for (const int i : fit_rows(split)) EXPECT_FALSE(marked.contains(i));
  }
  EXPECT_FALSE(split_poses(random_poses(100, 5), {}, 1).marked);
}

TEST(Split, ARuleThatIsStatedWinsOverMarks) {
  Measurements m = random_poses(100, 5);
  m.set[3] = SetMark::kHeld;
  const Split split = split_poses(m, share(0.2), 1);
  EXPECT_FALSE(split.marked);
  EXPECT_GT(held_rows(split).size(), 10U);
}

TEST(Split, AColumnWithoutAHeldRowIsRefused) {
  const Measurements m = random_poses(100, 5);
  EXPECT_THROW(split_poses(m, {.kind = HeldOutRule::Kind::kColumn}, 1), Failure);
  EXPECT_THROW(split_poses(random_poses(3, 5), folds(5), 1), Failure);
}

TEST(Split, RepeatsOfAHeldOutPoseAreNotFitted) {
  Measurements m = random_poses(30, 6);
  int marked = 0;
  for (int i = 0; i < m.size(); ++i) {  // of every repeated pose the last reading
    const bool last = i > 0 && m.replicate_group[i] == m.replicate_group[i - 1] &&
                      (i + 1 == m.size() || m.replicate_group[i] != m.replicate_group[i + 1]);
    m.set[i] = last ? SetMark::kHeld : SetMark::kFit;
    marked += last ? 1 : 0;
  }
  const Split split = split_poses(m, {.kind = HeldOutRule::Kind::kColumn}, 1);
  std::set<int> held;
  for (int i : held_rows(split)) held.insert(m.replicate_group[i]);
  for (int i : fit_rows(split)) EXPECT_FALSE(held.contains(m.replicate_group[i])) << i;
  EXPECT_EQ(held_rows(split).size(), static_cast<std::size_t>(marked));
  EXPECT_EQ(split.repeats_of_held, 2 * marked);
}

TEST(Split, AFileThatIsFittedCannotVouchForItself) {
  Measurements m = random_poses(30, 6);
  const int n = m.size();
  std::vector<int> twice;
  for (int i = 0; i < 2 * n; ++i) twice.push_back(i % n);
  m = pick(m, twice);
  m.file.assign(static_cast<std::size_t>(n), 0);
  m.file.resize(static_cast<std::size_t>(2 * n), 1);
  EXPECT_THROW(split_poses(m, {.kind = HeldOutRule::Kind::kFile}, 1), Failure);
}

std::vector<int> all_rows(const Measurements& m) {
  std::vector<int> out(static_cast<std::size_t>(m.size()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

TEST(EvenChoice, OfNotManyPosesIsAllOfThem) {
  const Measurements m = random_poses(100, 1);
  EXPECT_EQ(even_choice(m, all_rows(m), 100, 1), all_rows(m));
}

TEST(EvenChoice, OfManyPosesHasTheNumberAskedForWithTheirRepeats) {
  const Measurements m = random_poses(900, 1);
  const std::vector<int> chosen = even_choice(m, all_rows(m), 200, 7);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  EXPECT_EQ(chosen, even_choice(m, all_rows(m), 200, 7));
  EXPECT_NE(chosen, even_choice(m, all_rows(m), 200, 8));
  std::map<int, int> readings;
  for (const int row : chosen) ++readings[m.replicate_group[row]];
  EXPECT_EQ(readings.size(), 200U);
  EXPECT_LE(chosen.size(), 400U);
  EXPECT_TRUE(std::any_of(readings.begin(), readings.end(), [](auto& r) { return r.second == 2; }))
      << "repeats tell the noise";
}

TEST(EvenChoice, IsSpreadOverJointSpaceMoreEvenlyThanByChance) {
  const Measurements m = random_poses(4000, 3);
  std::vector<int> in_cell(100, 0);
  for (const int row : even_choice(m, all_rows(m), 1000, 1)) {
    if (row > 0 && m.replicate_group[row] == m.replicate_group[row - 1]) continue;
    ++in_cell[static_cast<std::size_t>(10 * static_cast<int>(10 * m.q(row, 0)) +
                                       static_cast<int>(10 * m.q(row, 1)))];
  }
  double variance = 0.0;
  for (const int count : in_cell) variance += std::pow(count - 10.0, 2) / 100.0;
  // By chance it would be that of the poses themselves, a quarter of 40, and of the drawing: 10.
  EXPECT_LT(variance, 7.0);
}

TEST(EvenChoice, APoseThatWasReadVeryOftenIsThereLessOften) {
  Measurements m = random_poses(30, 2);
  std::vector<int> rows;
  for (int repeat = 0; repeat < 50; ++repeat)
    for (int i = 0; i < m.size(); ++i) rows.push_back(i);
  const Measurements many = pick(m, rows);
  const std::vector<int> chosen = even_choice(many, all_rows(many), 300, 1);
  EXPECT_LE(chosen.size(), 600U);
  std::set<int> poses;
  for (const int row : chosen) poses.insert(many.replicate_group[row]);
  EXPECT_EQ(poses.size(), 30U);
}

TEST(EvenChoice, ASetupOfFewPosesKeepsAllOfThem) {
  Measurements m = random_poses(600, 5);
  m.setup.assign(static_cast<std::size_t>(m.size()), 0);
  std::set<int> small;
  for (int i = 0; i < m.size(); ++i)
    if (m.replicate_group[i] >= 595) m.setup[i] = 1, small.insert(m.replicate_group[i]);
  std::set<int> chosen;
  for (const int row : even_choice(m, all_rows(m), 100, 1)) chosen.insert(m.replicate_group[row]);
  for (const int pose : small) EXPECT_TRUE(chosen.contains(pose)) << pose;
}

}  // namespace
}  // namespace plumb::offline

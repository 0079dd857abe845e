// SPDX-License-Identifier: Apache-2.0
#include "cell/replicates.hpp"

#include <cstdio>
#include <random>

#include "support.hpp"

namespace plumb::offline {
namespace {

using Ints = std::vector<int>;

RowsN one_joint(const std::vector<double>& q) {
  RowsN out(static_cast<Eigen::Index>(q.size()), 1);
  for (std::size_t i = 0; i < q.size(); ++i) out(static_cast<Eigen::Index>(i), 0) = q[i];
  return out;
}

TEST(Replicates, ShareANameWithinAFile) {
  EXPECT_EQ(replicate_groups({"A", "B", "A", "C"}, {0, 0, 0, 0}, one_joint({1, 2, 1.0001, 3})),
            (Ints{0, 1, 0, 2}));
}

TEST(Replicates, ShareTheirJointsToANanoradian) {
  EXPECT_EQ(replicate_groups({"", "", "", ""}, {0, 0, 0, 0},
                             one_joint({1, 1 + 5e-10, 1 + 5e-9, 1 - 5e-10})),
            (Ints{0, 0, 1, 0}));
}

TEST(Replicates, AreNotMadeByFilesThatBothCountFromOne) {
  EXPECT_EQ(replicate_groups({"1", "2", "1", "2"}, {0, 0, 1, 1}, one_joint({1, 2, 7, 2.0005})),
            (Ints{0, 1, 2, 1}));
}

TEST(Replicates, AreTransitiveThroughNamesAndJoints) {
  EXPECT_EQ(replicate_groups({"A", "B", "B", "C"}, {0, 0, 0, 0}, one_joint({1, 1, 2, 2})),
            (Ints{0, 0, 0, 0}));
}

// Every pair compared, groups joined until nothing changes.
Ints slow_groups(const std::vector<std::string>& names, const RowsN& q) {
  const int n = static_cast<int>(names.size());
  Ints group(names.size());
  for (int i = 0; i < n; ++i) group[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const bool same = (!names[i].empty() && names[i] == names[j]) ||
                          (q.row(i) - q.row(j)).cwiseAbs().maxCoeff() < 1e-9;
        if (!same || group[i] <= group[j]) continue;
        group[i] = group[j];
        changed = true;
      }
  }
  return group;
}

TEST(Replicates, AgreeWithComparingEveryPair) {
  constexpr int kCases = 200;
  constexpr unsigned kSeed = 7;
  std::printf("%d cases, seed %u\n", kCases, kSeed);
  std::mt19937 random(kSeed);
  for (int c = 0; c < kCases; ++c) {
    const int n = 1 + static_cast<int>(random() % 60);
    RowsN q(n, 3);
    std::vector<std::string> names;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 3; ++k)
        q(i, k) = 0.5 * static_cast<int>(random() % 3) + 1e-10 * static_cast<int>(random() % 3);
      names.push_back(random() % 2 ? "" : "P" + std::to_string(random() % 40));
    }
    const Ints fast = replicate_groups({names.begin(), names.end()}, Ints(names.size(), 0), q);
    const Ints slow = slow_groups(names, q);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) EXPECT_EQ(fast[i] == fast[j], slow[i] == slow[j]);
  }
}

}  // namespace
}  // namespace plumb::offline

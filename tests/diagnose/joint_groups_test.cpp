// SPDX-License-Identifier: Apache-2.0
#include "diagnose/joint_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnose/constants.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

struct GroupsOfJoints : testing::Test {
  const WhitenedFit& arm = whitened_arm().whitened;

  /// What is left if the gears of these joints err alike.
  WhitenedFit uneven(const std::vector<int>& joints, double size) const {
    Eigen::VectorXd lines = noise_of(arm, 31);
    for (const int joint : joints)
      lines +=
          motion_of_size(arm, library_regressor(arm, entry_of("gear_harmonics", {joint})), size);
    return leaving(arm, lines);
  }
  /// Every joint alone, best first.
  static std::vector<Found> singles(const Scorer& scorer, const std::string& name) {
    std::vector<Found> out;
    for (int joint = 0; joint < scorer.whitened().joints(); ++joint) {
      const EffectEntry entry = entry_of(name, {joint});
      Found found{entry, {}, scorer.score(library_regressor(scorer.whitened(), entry)), {}, 0.0,
                  {},    0.0};
      found.score = found.ln_bayes() - std::log(100.0);
      out.push_back(std::move(found));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Found& a, const Found& b) { return a.ln_bayes() > b.ln_bayes(); });
    return out;
  }
};

TEST_F(GroupsOfJoints, JointsThatErrAlikeAreOneCandidate) {
  for (const std::vector<int>& joints : {std::vector{1, 2}, {0, 1}, {0, 2}, {0, 1, 2}}) {
    const WhitenedFit s = uneven(joints, 4.0);
    const Scorer scorer(s);
    const auto groups = joint_groups(scorer, singles(scorer, "gear_harmonics"));
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_EQ(groups[0].entry.joints, joints) << "each once, in their order";
  }
}

TEST_F(GroupsOfJoints, OneJointThatErrsAloneIsNoGroup) {
  for (const int joint : {0, 1, 2}) {
    const WhitenedFit s = uneven({joint}, 4.0);
    const Scorer scorer(s);
    EXPECT_TRUE(joint_groups(scorer, singles(scorer, "gear_harmonics")).empty()) << joint;
  }
}

TEST_F(GroupsOfJoints, NoiseIsNoGroup) {
  const WhitenedFit s = uneven({}, 0.0);
  const Scorer scorer(s);
  for (const char* name : {"gear_harmonics", "joint_compliance"})
    EXPECT_TRUE(joint_groups(scorer, singles(scorer, name)).empty()) << name;
}

TEST_F(GroupsOfJoints, OfNothingOrOfOneJointThereIsNone) {
  const WhitenedFit s = uneven({1, 2}, 4.0);
  const Scorer scorer(s);
  EXPECT_TRUE(joint_groups(scorer, {}).empty());
  EXPECT_TRUE(joint_groups(scorer, {singles(scorer, "gear_harmonics").front()}).empty());
}

/// The group is worth what each further joint had to pay, and its evidence is that of its columns.
TEST_F(GroupsOfJoints, AGroupHasTheEvidenceOfItsJointsTogetherAndMoreThanAnyOfThem) {
  const WhitenedFit s = uneven({1, 2}, 4.0);
  const Scorer scorer(s);
  const auto library = singles(scorer, "gear_harmonics");
  const auto groups = joint_groups(scorer, library);
  ASSERT_EQ(groups.size(), 1U);
  const RegressorScore own = scorer.score(library_regressor(s, groups[0].entry));
  EXPECT_NEAR(groups[0].ln_bayes(), own.evidence.ln_bayes, 1e-9);
  const double price = kSupported + std::log(static_cast<double>(library.size()));
  EXPECT_GE(groups[0].ln_bayes(), library[0].ln_bayes() + price);
  EXPECT_LT(groups[0].score, library[0].score + groups[0].ln_bayes() - library[0].ln_bayes())
      << "the search for the other joint was paid for";
}

/// By its group_share: 0.7 of the motion of the best one.
TEST_F(GroupsOfJoints, AJointThatErrsMuchLessStaysOut) {
  Eigen::VectorXd lines = 0.5 * noise_of(arm, 32);
  for (const auto& [joint, size] : {std::pair{1, 6.0}, {2, 1.5}})
    lines += motion_of_size(arm, library_regressor(arm, entry_of("gear_harmonics", {joint})), size);
  // An error besides, so that the smaller one does not reach the noise.
  lines += motion_of_size(arm, library_regressor(arm, entry_of("tool_sag")), 3.0);
  const WhitenedFit s = leaving(arm, lines);
  const Scorer scorer(s);
  for (const Found& group : joint_groups(scorer, singles(scorer, "gear_harmonics")))
    EXPECT_EQ(std::count(group.entry.joints.begin(), group.entry.joints.end(), 2), 0);
}

TEST_F(GroupsOfJoints, LawsThatActAtOneJointAreNeverGrouped) {
  Eigen::VectorXd lines = noise_of(arm, 33);
  for (const int joint : {1, 2})
    lines += motion_of_size(arm, library_regressor(arm, entry_of("axis_wobble", {joint})), 5.0);
  const WhitenedFit s = leaving(arm, lines);
  const Scorer scorer(s);
  EXPECT_TRUE(joint_groups(scorer, singles(scorer, "axis_wobble")).empty());
}

}  // namespace
}  // namespace plumb::offline

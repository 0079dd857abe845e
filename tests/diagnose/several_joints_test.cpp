// SPDX-License-Identifier: Apache-2.0
// One cause at several joints at once, each of one number, is not called another law of four
// numbers a joint.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnose/diagnosis.hpp"
#include "tests/diagnose/hiding.hpp"

namespace plumb::offline {
namespace {

Diagnosis diagnosed(const BlindRequest& request) {
  const BlindCase blind = make_blind_case(request);
  return diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
}

/// Whether the first candidate is of that law, or may be.
bool names(const Diagnosis& d, const std::string& law) {
  return d.candidates.front().entry.name == law ||
         std::any_of(d.alternatives.begin(), d.alternatives.end(),
                     [&](const Alternative& a) { return a.entry.name == law; });
}

TEST(SeveralJoints, AWrongScaleOfTheirEncodersIsNamedAsSuch) {
  for (const auto& hidden : {std::vector<std::string>{"encoder_scale:J1:4", "encoder_scale:J2:4"},
                             {"encoder_scale:J2:5", "encoder_scale:J3:4"},
                             {"encoder_scale:J1:4", "encoder_scale:J2:4", "encoder_scale:J3:4"}})
    for (const int poses : {90, 240}) {
      const Diagnosis d = diagnosed(hiding(hidden, poses));
      ASSERT_FALSE(d.candidates.empty());
      EXPECT_TRUE(names(d, "encoder_scale")) << poses << ": " << d.text;
      EXPECT_TRUE(std::none_of(d.added.begin(), d.added.end(),
                               [](const Addition& a) { return a.entry.name == "gear_harmonics"; }))
          << poses << ": " << d.text_after;
    }
}

TEST(SeveralJoints, WavesOfTheirGearsStayWaves) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const Diagnosis d = diagnosed(hiding({"gear_harmonics:J2:5", "gear_harmonics:J3:5"}, 90, seed));
    ASSERT_FALSE(d.candidates.empty());
    EXPECT_EQ(d.candidates.front().entry.name, "gear_harmonics") << d.text;
    EXPECT_TRUE(std::none_of(d.added.begin(), d.added.end(), [](const Addition& a) {
      return a.entry.name == "encoder_scale";
    })) << d.text_after;
  }
}

}  // namespace
}  // namespace plumb::offline

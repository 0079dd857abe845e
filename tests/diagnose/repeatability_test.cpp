// SPDX-License-Identifier: Apache-2.0
// An arm whose joints do not come back to the same place hides no law: nothing is named, the joints
// are, and the floor holds what they scatter.
#include <gtest/gtest.h>

#include "diagnose/diagnosis.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {
namespace {

BlindRequest scattering(double rad, std::uint64_t seed, int poses = 150) {
  BlindRequest out;
  out.seed = seed;
  out.poses = poses;
  out.sigma_m = 10e-6;
  out.imperfections.joint_scatter.assign(6, rad);
  return out;
}

Diagnosis diagnosed(const BlindRequest& request) {
  const BlindCase blind = make_blind_case(request);
  return diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
}

TEST(DiagnoseRepeatability, ScatterOfTheJointsIsNoEffect) {
  for (const int poses : {45, 150}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Diagnosis d = diagnosed(scattering(40e-6, seed, poses));
      EXPECT_EQ(d.finding, Finding::kComplete)
          << poses << " poses, seed " << seed << ": " << d.text;
      EXPECT_TRUE(d.added.empty()) << d.text_after;
    }
  }
}

TEST(DiagnoseRepeatability, ItIsSaidWithItsSizeBesideTheFloorThatWasMeasured) {
  const Diagnosis d = diagnosed(scattering(40e-6, 5));
  ASSERT_TRUE(d.repeatability.supported());
  ASSERT_EQ(d.repeatability.std.size(), 6U);
  EXPECT_NEAR(d.repeatability.std[0], 40e-6, 12e-6);
  EXPECT_NEAR(d.repeatability.std[1], 40e-6, 12e-6);
  EXPECT_NE(d.text.find("Repeatability of the joints"), std::string::npos) << d.text;
  EXPECT_NEAR(d.floor.sigma_m, 10e-6, 2e-6) << "the tracker's noise alone";
  EXPECT_GT(d.floor.inferred_times(), 2.0);
  EXPECT_NE(d.text.find("inferred from what the model leaves"), std::string::npos) << d.text;
  EXPECT_EQ(d.text.find("times the noise floor"), std::string::npos) << d.text;
}

TEST(DiagnoseRepeatability, AnArmThatRepeatsIsNotSaidToScatter) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Diagnosis d = diagnosed(scattering(0.0, seed));
    EXPECT_FALSE(d.repeatability.supported()) << "seed " << seed;
  }
}

TEST(DiagnoseRepeatability, AnEffectThatIsClearlyThereIsStillFound) {
  BlindRequest request = scattering(25e-6, 7, 300);
  request.effects = {"joint_compliance:J2:5"};
  const Diagnosis d = diagnosed(request);
  ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
  EXPECT_TRUE(d.candidates.front().entry.name == "joint_compliance" ||
              d.candidates.front().entry.name == "gravity_free")
      << d.text;
  EXPECT_LT(d.after.mean, d.before.mean);
}

}  // namespace
}  // namespace plumb::offline

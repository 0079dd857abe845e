// SPDX-License-Identifier: Apache-2.0
#include "diagnose/model_parts.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "plumb/runtime/detail/effects/gear_harmonics.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// An arm whose J2 yields, with that in the model and with harmonics of J5, which it does not have.
struct PartsOfAModel {
  PartsOfAModel() {
    BlindRequest request;
    request.effects = {"joint_compliance:J2:3"};
    request.poses = 80;
    request.fresh_poses = 1;
    request.seed = 9;
    blind = make_blind_case(request);
    blind.cell.effects.push_back(yields);
    blind.cell.effects.push_back(needless);
    const Measurements& measured = blind.measured.measured;
    std::vector<int> rows;
    for (int i = 0; i < measured.size(); ++i) rows.push_back(i);
    calibration = calibrate(blind.cell, measured, rows);
    whitened = make_whitened_fit(blind.cell, measured, calibration,
                                 without_outliers(rows, calibration.outliers), {});
  }
  PartsOfAModel(const PartsOfAModel&) = delete;

  EffectEntry yields = entry_of("joint_compliance", {1});
  EffectEntry needless = entry_of("gear_harmonics", {4});
  BlindCase blind;
  Calibration calibration;
  WhitenedFit whitened;
};

struct ModelParts : testing::Test {
  static constexpr double kUsual = effects::GearHarmonics::kInfo.parameters[0].typical;

  static const PartsOfAModel& arm() {
    static const PartsOfAModel one;
    return one;
  }
  std::optional<EffectEntry> loses(const std::vector<EffectEntry>& given,
                                   const EffectEntry& fresh) const {
    return lost(arm().blind.cell, arm().whitened, arm().calibration, given, fresh);
  }
  static std::vector<double>& numbers_of(Calibration& calibration, const EffectEntry& entry) {
    for (auto& effect : calibration.state.arm.effects)
      if (effect.name == entry.name) return effect.parameters;
    throw std::logic_error("no such effect");
  }
  /// With harmonics of J5 that are so many times the usual ones.
  std::vector<Oversized> with_gear(double times, const std::vector<EffectEntry>& given = {}) const {
    Calibration other = arm().calibration;
    for (double& p : numbers_of(other, arm().needless)) p = times * kUsual;
    return oversized(arm().blind.cell, arm().whitened, other, given);
  }
  Found explaining(double share) const {
    Found out{entry_of("base_compliance"), {}, {}, {}, 0.0, {}, 0.0};
    out.scored.explained = share;
    return out;
  }
};

TEST_F(ModelParts, WhatNeverHadAnyEvidenceIsLostAndWhatThePosesShowIsNot) {
  const auto out = loses({}, {});
  ASSERT_TRUE(out);
  EXPECT_EQ(out->name, arm().needless.name);
  EXPECT_EQ(out->joints, arm().needless.joints);
}

TEST_F(ModelParts, WhatTheUserGaveAndWhatWasJustAddedIsNeverLost) {
  EXPECT_FALSE(loses({arm().needless}, {}));
  EXPECT_FALSE(loses({}, arm().needless));
  EXPECT_FALSE(loses({arm().yields, arm().needless}, {}));
}

TEST_F(ModelParts, EffectsOfUsualSizeAreNotOversized) { EXPECT_TRUE(with_gear(1.0).empty()); }

/// Small beside the strongest effect; from some size on it is one of its own.
TEST_F(ModelParts, ARemainderIsSmallAndStaysSoIfItIsEvenSmaller) {
  WhitenedFit above = arm().whitened;
  above.noise = {0.01 * above.Q / static_cast<double>(above.fit_lines), 40.0, true};
  const auto remains = [&](double share) {
    return is_remainder(arm().blind.cell, above, arm().calibration, explaining(share));
  };
  EXPECT_TRUE(remains(0.0));
  bool was = true;
  for (double share = 1e-6; share < 1e4; share *= 3.0) {
    const bool is = remains(share);
    EXPECT_TRUE(was || !is) << share;
    was = is;
  }
  EXPECT_FALSE(was);
}

/// A wave of another number, a finer law of the same cause: no remainder of this one.
TEST_F(ModelParts, IsNeverARemainderOfALawThatItRefines) {
  WhitenedFit above = arm().whitened;
  above.noise = {0.01 * above.Q / static_cast<double>(above.fit_lines), 40.0, true};
  Calibration only = arm().calibration;
  for (double& p : numbers_of(only, arm().needless)) p = 0.0;
  Found finer = explaining(1e-3);
  EXPECT_TRUE(is_remainder(arm().blind.cell, above, only, finer));
  finer.entry = entry_of("joint_compliance_soft", {1});
  EXPECT_FALSE(is_remainder(arm().blind.cell, above, only, finer));
  finer.entry = entry_of("joint_compliance_soft", {2});
  EXPECT_TRUE(is_remainder(arm().blind.cell, above, only, finer)) << "of another joint";
}

}  // namespace
}  // namespace plumb::offline

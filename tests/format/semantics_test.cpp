// SPDX-License-Identifier: Apache-2.0
// Each rule of the semantic check, broken alone.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "golden_models.hpp"
#include "plumb/format/writer.hpp"
#include "semantic_check.hpp"

namespace plumb::format {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Rule {
  const char* name;
  std::function<void(Model&)> break_it;
};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{
      {"NoJoints", [](Model& m) { m.nominal.joints.clear(); }},
      {"TooManyJoints", [](Model& m) { m.nominal.joints.resize(10, m.nominal.joints[0]); }},
      {"ChainsDifferInCount", [](Model& m) { m.calibrated.joints.pop_back(); }},
      {"ChainsDifferInType", [](Model& m) { m.calibrated.joints[1].type = JointType::kPrismatic; }},
      {"ChainsDifferInName", [](Model& m) { m.calibrated.joints[1].name = "K"; }},
      {"ChainsDifferInConvention",
       [](Model& m) { m.calibrated.convention = Convention::kModified; }},
      {"JointWithoutName", [](Model& m) { m.nominal.joints[0].name = ""; }},
      {"NaNInDh", [](Model& m) { m.calibrated.joints[3].a = kNaN; }},
      {"InfiniteAngle", [](Model& m) { m.calibrated.joints[3].alpha = kInf; }},
      {"HugeLength", [](Model& m) { m.calibrated.joints[3].d = 600.0; }},
      {"Scale", [](Model& m) { m.calibrated.joints[3].scale = 0.0; }},
      {"EmptyLimits", [](Model& m) { m.nominal.joints[0].q_max = m.nominal.joints[0].q_min; }},
      {"Twist", [](Model& m) { m.calibrated.joints[0].post.e[1] = 2.0; }},
      {"Quaternion",
       [](Model& m) {
         m.nominal.tool.q = {1.0, 0.1, 0.0, 0.0};
       }},
      {"Gravity", [](Model& m) { m.gravity[2] = kNaN; }},
      {"ControlCharacter", [](Model& m) { m.serial = "a\nb"; }},
      {"LongName", [](Model& m) { m.robot_name = std::string(300, 'x'); }},
      {"EffectName", [](Model& m) { m.effects[0].name = "Gear Ripple"; }},
      {"EffectVersion", [](Model& m) { m.effects[0].version = 0; }},
      {"EffectJoint", [](Model& m) { m.effects[0].joints[0] = 6; }},
      {"EffectParameter", [](Model& m) { m.effects[0].parameters[0] = kNaN; }},
      {"EffectFallback", [](Model& m) { m.effects[0].context[0].fallback = kInf; }},
      {"TooManyEffects", [](Model& m) { m.effects.resize(65, m.effects[0]); }},
      {"DomainMissing", [](Model& m) { m.domain = Domain{}; }},
      {"DomainEmpty", [](Model& m) { m.domain.q_max[2] = m.domain.q_min[2]; }},
      {"DomainSizes", [](Model& m) { m.domain.q_max.pop_back(); }},
      {"Fade", [](Model& m) { m.domain.fade = 0.0; }},
      {"TreeCycle", [](Model& m) { m.trees[0].nodes[1].low = 0; }},
      {"TreeSelf", [](Model& m) { m.trees[0].nodes[1].low = 1; }},
      {"TreeNowhere", [](Model& m) { m.trees[0].nodes[0].high = 9; }},
      {"TreeLeafTwice", [](Model& m) { m.trees[0].nodes[1].high = ~0; }},
      {"TreeLeafOutside", [](Model& m) { m.trees[0].nodes[1].high = ~7; }},
      {"TreeInput", [](Model& m) { m.trees[0].nodes[0].input = 6; }},
      {"TreeThreshold", [](Model& m) { m.trees[0].nodes[0].threshold = 1.5; }},
      {"TreeThresholdNaN", [](Model& m) { m.trees[0].nodes[0].threshold = kNaN; }},
      {"TreeDepth", [](Model& m) { m.trees[0].depth = 2; }},
      {"TreeCoefficients", [](Model& m) { m.trees[0].coefficients.pop_back(); }},
      {"TreeCoefficientNaN", [](Model& m) { m.trees[0].coefficients[3] = kNaN; }},
      {"TreeBounds", [](Model& m) { std::swap(m.trees[0].bounds[0], m.trees[0].bounds[1]); }},
      {"TreeNodesWithoutLeaves", [](Model& m) { m.trees[2].nodes.push_back({}); }},
      {"TreeBlended",
       [](Model& m) {
         m.trees[0].blend_half_width = {0.1, 0.1, 0.1};
       }},
      {"GuardSize", [](Model& m) { m.guard.max_correction_m = 0.0; }},
      {"GuardSlew", [](Model& m) { m.guard.slew_m_per_s = kNaN; }},
      {"GuardScale", [](Model& m) { m.guard.length_scale_m = -1.0; }},
      {"HeldOutOrder", [](Model& m) { m.provenance.held_out.mean_m = 1e-3; }},
      {"HeldOutNegative", [](Model& m) { m.provenance.noise_floor_m = -1.0; }},
      {"Hash", [](Model& m) { m.provenance.inputs[0].sha256 = "abc"; }},
      {"CovarianceSize", [](Model& m) { m.provenance.covariance.pop_back(); }},
      {"CovarianceSign", [](Model& m) { m.provenance.covariance[2] = -1.0F; }},
  };
  return all;
}

class SemanticRule : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SemanticRule, BrokenAloneMakesTheModelUnsoundAndUnwritable) {
  Model m = six_axis_model();
  ASSERT_EQ(internal::unsoundness(m), std::nullopt);
  rules()[GetParam()].break_it(m);
  const auto finding = internal::unsoundness(m);
  ASSERT_TRUE(finding.has_value());
  EXPECT_FALSE(finding->empty());
  EXPECT_THROW(write_model(m), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(All, SemanticRule, ::testing::Range<std::size_t>(0, rules().size()),
                         [](const auto& rule) { return rules()[rule.param].name; });

}  // namespace
}  // namespace plumb::format

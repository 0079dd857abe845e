// SPDX-License-Identifier: Apache-2.0
// Each rule of the semantic check, broken alone; the rules stand in the other files of this test.
#include "rule.hpp"

#include <stdexcept>

#include "consistency.hpp"
#include "golden_models.hpp"
#include "plumb/format/writer.hpp"
#include "random_model.hpp"
#include "semantic_check.hpp"

namespace plumb::format {
namespace {

TEST_P(SemanticRule, BrokenAloneMakesTheModelUnsoundAndUnwritable) {
  Model m = six_axis_model();
  ASSERT_EQ(internal::unsoundness(m), std::nullopt);
  GetParam().break_it(m);
  const auto finding = internal::unsoundness(m);
  ASSERT_TRUE(finding.has_value());
  EXPECT_NE(finding->find(GetParam().says), std::string::npos) << *finding;
  try {
    write_model(m);
    ADD_FAILURE() << "an unsound model was written";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), *finding);
  }
}

TEST(SemanticCheck, FindsNothingInSoundModels) {
  for (const auto& [name, model] : golden_models())
    EXPECT_EQ(internal::unsoundness(model), std::nullopt) << name;
  for (std::uint64_t seed = 1000; seed < 1100; ++seed)
    EXPECT_EQ(internal::unsoundness(random_model(seed)), std::nullopt) << seed;
}

TEST(SemanticCheck, AllowsWhatIsAtTheLimit) {
  Model m = six_axis_model();
  m.calibrated.joints[0].scale = 2.0;
  m.calibrated.joints[1].d = -100.0;
  m.domain.fade = 1.0;
  m.trees[0].nodes[0].threshold = -1.0;
  m.trees[0].bounds[0] = m.trees[0].bounds[1];
  m.guard.ramp_s = 0.0;
  m.robot_name = std::string(256, 'x');
  m.serial = "Größe 7 µ 東 😀";
  m.provenance.held_out = {1, 1e-4, 1e-4, 1e-4, 1e-4};
  m.provenance.covariance[0] = 0.0F;
  EXPECT_EQ(internal::unsoundness(m), std::nullopt);
}

TEST(SemanticCheck, AllowsTreesOfEveryKindAtTheirLimits) {
  Model m = blended_model();
  m.trees[0].blend_half_width = {2.0};
  m.trees[0].region[0] = -4.0F;
  m.trees[0].region[5] = m.trees[0].region[4];
  m.trees[0].region[7] = 4.0F;
  m.trees[0].sigma = {0.0F, 1.0F};
  m.trees[1].blend_half_width = {1e-9, 2.0};
  m.trees[1].directions = {-1.0, 0.0, 1.0 - 1e-10, 0.0};
  m.trees[2] = {};
  m.trees[2].degree = 2;
  EXPECT_EQ(internal::unsoundness(m), std::nullopt);
}

TEST(SemanticCheck, NeedsNoDomainWithoutTrees) {
  Model m = six_axis_model();
  m.trees = {};
  m.domain = {};
  m.provenance.covariance.clear();
  EXPECT_EQ(internal::unsoundness(m), std::nullopt);
}

}  // namespace
}  // namespace plumb::format

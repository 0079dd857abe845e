// SPDX-License-Identifier: Apache-2.0
// Rules about what makes a tree more than crisp and affine.
#include "rule.hpp"

namespace plumb::format {
namespace {

constexpr std::size_t kNodes = 3, kLeaves = 4, kJoints = 6;  // of the first tree

Rule half_width(const std::string& name, double bad) {
  return {name, "tree 1: a half width is out of range", [bad](Model& m) {
            m.trees[0].blend_half_width = {0.5, 0.5, bad};
          }};
}

std::vector<Rule> blend_rules() {
  return {
      {"HalfWidthMissing", "tree 1: the number of half widths",
       [](Model& m) { m.trees[0].blend_half_width.assign(kNodes - 1, 0.5); }},
      {"HalfWidthTooMany", "tree 1: the number of half widths",
       [](Model& m) { m.trees[0].blend_half_width.assign(kLeaves, 0.5); }},
      {"HalfWidthWithoutLeaves", "tree 3: the number of half widths",
       [](Model& m) { m.trees[2].blend_half_width.assign(1, 0.5); }},
      half_width("HalfWidthZero", 0.0),
      half_width("HalfWidthNegative", -0.5),
      half_width("HalfWidthTooSmallToDivideBy", 0.9e-9),
      half_width("HalfWidthBeyondTheBox", 2.0000001),
      half_width("HalfWidthNaN", kNaN),
      half_width("HalfWidthInfinite", kInf),
  };
}

std::vector<Rule> degree_rules() {
  return {
      {"Zero", "tree 1: its leaves are of degree 0", [](Model& m) { m.trees[0].degree = 0; }},
      {"Three", "tree 2: its leaves are of degree 3", [](Model& m) { m.trees[1].degree = 3; }},
      {"ThreeWithoutLeaves", "tree 3: its leaves are of degree 3",
       [](Model& m) { m.trees[2].degree = 3; }},
      {"QuadraticWithAffineCoefficients", "the number of coefficients",
       [](Model& m) { m.trees[0].degree = 2; }},
      {"AffineWithQuadraticCoefficients", "the number of coefficients",
       [](Model& m) { m.trees[0].coefficients.resize(kLeaves * 28); }},
  };
}

/// Along the axes, so sound, but for what `break_it` does.
Rule direction(const std::string& name, const std::string& says,
               const std::function<void(Tree&)>& break_it) {
  return {name, says, [break_it](Model& m) {
            Tree& tree = m.trees[0];
            tree.directions.assign(kNodes * kJoints, 0.0);
            for (std::size_t i = 0; i < kNodes; ++i) {
              tree.directions[i * kJoints + tree.nodes[i].input] = i == 1 ? -1.0 : 1.0;
              tree.nodes[i].input = 0;
            }
            break_it(tree);
          }};
}

std::vector<Rule> direction_rules() {
  return {
      direction("Missing", "the number of directions", [](Tree& t) { t.directions.pop_back(); }),
      direction("TooMany", "the number of directions",
                [](Tree& t) { t.directions.resize(kLeaves * kJoints); }),
      direction("TooLong", "the direction of node 1 is not of length 1",
                [](Tree& t) { t.directions[kJoints + 2] = 1e-8; }),
      direction("OfEuclideanLengthOne", "the direction of node 0 is not of length 1",
                [](Tree& t) { t.directions[0] = 0.6, t.directions[1] = 0.8; }),
      direction("Nowhere", "the direction of node 2 is not of length 1",
                [](Tree& t) { t.directions[2 * kJoints + 5] = 0.0; }),
      direction("NaN", "the direction of node 2 is not of length 1",
                [](Tree& t) { t.directions.back() = kNaN; }),
      direction("Infinite", "the direction of node 0 is not of length 1",
                [](Tree& t) { t.directions[0] = kInf; }),
      direction("AndAnInput", "node 2 has an input and a direction",
                [](Tree& t) { t.nodes[2].input = 5; }),
  };
}

/// The whole box for every leaf, so sound, but for one side of leaf 3.
Rule region(const std::string& name, float low, float high) {
  return {name, "tree 1: the region of a leaf is no range", [low, high](Model& m) {
            for (std::size_t i = 0; i < kLeaves * kJoints; ++i)
              m.trees[0].region.insert(m.trees[0].region.end(), {-1.0F, 1.0F});
            m.trees[0].region[2 * kLeaves * kJoints - 2] = low;
            m.trees[0].region[2 * kLeaves * kJoints - 1] = high;
          }};
}

Rule sigma(const std::string& name, float bad) {
  return {name, "tree 1: a sigma is out of range", [bad](Model& m) {
            m.trees[0].sigma = {1e-6F, 1e-6F, bad, 1e-6F};
          }};
}

std::vector<Rule> region_and_sigma_rules() {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  return {
      {"RegionMissing", "the number of region limits",
       [](Model& m) { m.trees[0].region.assign(2 * kLeaves * kJoints - 1, 0.0F); }},
      {"RegionWithoutLeaves", "tree 3: the number of region limits",
       [](Model& m) { m.trees[2].region.assign(2 * kJoints, 0.0F); }},
      region("RegionSwapped", 0.5F, -0.5F),
      region("RegionLowNaN", kNone, 1.0F),
      region("RegionHighNaN", -1.0F, kNone),
      region("RegionFarBelow", -4.1F, 1.0F),
      region("RegionFarAbove", -1.0F, 4.1F),
      region("RegionInfinite", -1.0F, std::numeric_limits<float>::infinity()),
      {"SigmaMissing", "the number of sigmas",
       [](Model& m) { m.trees[0].sigma.assign(kLeaves - 1, 1e-6F); }},
      {"SigmaTooMany", "the number of sigmas",
       [](Model& m) { m.trees[0].sigma.assign(kLeaves + 1, 1e-6F); }},
      {"SigmaWithoutLeaves", "tree 3: the number of sigmas",
       [](Model& m) { m.trees[2].sigma.assign(1, 1e-6F); }},
      sigma("SigmaNegative", -1e-9F),
      sigma("SigmaNaN", kNone),
      sigma("SigmaHuge", 1.001F),
  };
}

INSTANTIATE_TEST_SUITE_P(Blends, SemanticRule, ::testing::ValuesIn(blend_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Degrees, SemanticRule, ::testing::ValuesIn(degree_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Directions, SemanticRule, ::testing::ValuesIn(direction_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(RegionsAndSigmas, SemanticRule,
                         ::testing::ValuesIn(region_and_sigma_rules()), name_of);

}  // namespace
}  // namespace plumb::format

// SPDX-License-Identifier: Apache-2.0
// Rules about the trees and the domain they were trained in.
#include "rule.hpp"

namespace plumb::format {
namespace {

/// Every inner node has one leaf and the next node: as deep as it has nodes.
Tree list_tree(std::size_t nodes, std::size_t joints) {
  Tree out;
  out.depth = static_cast<std::uint16_t>(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    out.nodes.push_back({0.0, 0, static_cast<std::int16_t>(~i),
                         static_cast<std::int16_t>(i + 1 < nodes ? i + 1 : ~nodes), 0});
  out.coefficients.resize((nodes + 1) * (joints + 1));
  out.bounds.resize(2 * (nodes + 1));
  return out;
}

std::vector<Rule> shape_rules() {
  return {
      {"Cycle", "tree 1: node 1 leads to node 0", [](Model& m) { m.trees[0].nodes[1].low = 0; }},
      {"Itself", "node 1 leads to node 1", [](Model& m) { m.trees[0].nodes[1].low = 1; }},
      {"Nowhere", "node 0 leads to node 3", [](Model& m) { m.trees[0].nodes[0].high = 3; }},
      {"NodeTwice", "node 2 is reached twice", [](Model& m) { m.trees[0].nodes[1].high = 2; }},
      {"NodeNever", "node 1 is never reached", [](Model& m) { m.trees[0].nodes[0].high = 2; }},
      {"LeafTwice", "leaf 0 is reached twice", [](Model& m) { m.trees[0].nodes[1].high = ~0; }},
      {"LeafOutside", "leads to leaf 7", [](Model& m) { m.trees[0].nodes[1].high = ~7; }},
      {"LeafFarOutside", "leads to leaf 32767",
       [](Model& m) { m.trees[0].nodes[1].high = std::numeric_limits<std::int16_t>::min(); }},
      {"DepthTooSmall", "its depth is 3, not 2", [](Model& m) { m.trees[0].depth = 2; }},
      {"DepthTooLarge", "its depth is 3, not 4", [](Model& m) { m.trees[0].depth = 4; }},
      {"TooDeep", "65 compares deep", [](Model& m) { m.trees[1] = list_tree(65, 6); }},
      {"DepthWithoutNodes", "its depth is 0, not 1",
       [](Model& m) {
         m.trees[2] = list_tree(0, 6);
         m.trees[2].depth = 1;
       }},
      {"NodesWithoutLeaves", "tree 3: it has nodes but no leaves",
       [](Model& m) { m.trees[2].nodes.push_back({}); }},
      {"DepthWithoutLeaves", "tree 3", [](Model& m) { m.trees[2].depth = 1; }},
      {"MissingNode", "nodes and leaves do not match",
       [](Model& m) { m.trees[0].nodes.pop_back(); }},
      {"TooManyLeaves", "it has 4097 leaves", [](Model& m) { m.trees[0] = list_tree(4096, 6); }},
  };
}

std::vector<Rule> number_rules() {
  return {
      {"Input", "node 0 asks for input 6", [](Model& m) { m.trees[0].nodes[0].input = 6; }},
      {"Threshold", "threshold outside", [](Model& m) { m.trees[0].nodes[0].threshold = 1.5; }},
      {"ThresholdNaN", "threshold outside", [](Model& m) { m.trees[0].nodes[0].threshold = kNaN; }},
      {"Reserved", "reserved field", [](Model& m) { m.trees[0].nodes[2].reserved = 1; }},
      {"CoefficientMissing", "number of coefficients",
       [](Model& m) { m.trees[0].coefficients.pop_back(); }},
      {"CoefficientsWithoutLeaves", "tree 3: the number of coefficients",
       [](Model& m) { m.trees[2].coefficients.push_back(0.0); }},
      {"CoefficientNaN", "a coefficient", [](Model& m) { m.trees[0].coefficients[3] = kNaN; }},
      {"CoefficientHuge", "a coefficient", [](Model& m) { m.trees[1].coefficients[3] = 1e4; }},
      {"BoundMissing", "only one bound", [](Model& m) { m.trees[0].bounds.pop_back(); }},
      {"BoundsSwapped", "bounds of leaf 1",
       [](Model& m) { std::swap(m.trees[0].bounds[2], m.trees[0].bounds[3]); }},
      {"BoundNaN", "bounds of leaf 0", [](Model& m) { m.trees[0].bounds[0] = kNaN; }},
      {"BoundInfinite", "bounds of leaf 0", [](Model& m) { m.trees[0].bounds[1] = kInf; }},
      {"BoundHuge", "bounds of leaf 3", [](Model& m) { m.trees[0].bounds[6] = -1.5; }},
  };
}

std::vector<Rule> domain_rules() {
  return {
      {"Missing", "no trained domain", [](Model& m) { m.domain = Domain{}; }},
      {"Empty", "domain of joint 3", [](Model& m) { m.domain.q_max[2] = m.domain.q_min[2]; }},
      {"TooThinToDivideBy", "domain of joint 3",
       [](Model& m) { m.domain.q_max[2] = m.domain.q_min[2] + 1e-300; }},
      {"LowerNaN", "domain of joint 1", [](Model& m) { m.domain.q_min[0] = kNaN; }},
      {"UpperInfinite", "domain of joint 6", [](Model& m) { m.domain.q_max[5] = kInf; }},
      {"Sizes", "limits of different count", [](Model& m) { m.domain.q_max.pop_back(); }},
      {"TooFewJoints", "has 5 joints",
       [](Model& m) {
         m.domain.q_min.pop_back();
         m.domain.q_max.pop_back();
       }},
      {"FadeZero", "fade", [](Model& m) { m.domain.fade = 0.0; }},
      {"FadeOverOne", "fade", [](Model& m) { m.domain.fade = 1.01; }},
      {"FadeNaNWithoutTrees", "fade",
       [](Model& m) {
         m.trees = {};
         m.domain = {{}, {}, kNaN};
       }},
  };
}

INSTANTIATE_TEST_SUITE_P(TreeShapes, SemanticRule, ::testing::ValuesIn(shape_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(TreeNumbers, SemanticRule, ::testing::ValuesIn(number_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Domains, SemanticRule, ::testing::ValuesIn(domain_rules()), name_of);

}  // namespace
}  // namespace plumb::format

// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/crisp_trees.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "tests/runtime/random_tree.hpp"

namespace plumb {
namespace {

using Trees = std::array<format::Tree, format::kTreeAxes>;

/// Half of them as the cycle meets them most, six inputs and affine leaves; one in eight is empty.
Trees random_trees(tests::Random& random, int& inputs) {
  const bool usual = random.below(2) == 0;
  inputs = usual ? 6 : 1 + random.below(format::kMaxJoints);
  Trees out;
  for (format::Tree& tree : out) {
    if (random.below(8) == 0) continue;
    tree = test::random_tree(random, {.inputs = inputs,
                                      .leaves = 1 + random.below(60),
                                      .degree = usual ? 1 : 1 + random.below(2),
                                      .region = !usual && random.below(2) == 0});
  }
  return out;
}

/// Anywhere in the box, often on its sides or on a threshold.
std::vector<double> random_input(tests::Random& random, const Trees& trees, int inputs) {
  std::vector<double> out(static_cast<std::size_t>(inputs));
  for (double& x : out) x = std::clamp(random.uniform(-1.5, 1.5), -1.0, 1.0);
  for (const format::Tree& tree : trees) {
    if (tree.nodes.empty()) continue;
    const auto& node = tree.nodes[random.below(static_cast<int>(tree.nodes.size()))];
    out[node.input] = node.threshold;
  }
  return out;
}

TEST(CrispTrees, SayToTheBitWhatEachTreeSaysAlone) {
  tests::Random random(23);
  for (int round = 0; round < 2000; ++round) {
    int inputs = 0;
    const Trees trees = random_trees(random, inputs);
    std::array<TreeView, format::kTreeAxes> alone;
    for (std::size_t axis = 0; axis < trees.size(); ++axis)
      alone[axis] = TreeView(trees[axis], inputs);
    const CrispTrees together(alone);
    for (int i = 0; i < 50; ++i) {
      const std::vector<double> u = random_input(random, trees, inputs);
      CrispTrees::Values said;
      together.evaluate(u, said);
      for (std::size_t axis = 0; axis < trees.size(); ++axis)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(said[axis]),
                  std::bit_cast<std::uint64_t>(alone[axis].evaluate(u)))
            << "round " << round << ", axis " << axis;
    }
  }
}

}  // namespace
}  // namespace plumb

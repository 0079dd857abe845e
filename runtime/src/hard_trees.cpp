// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/hard_trees.hpp"

#include <algorithm>
#include <bit>

#include "hard_walks.hpp"

namespace plumb {
namespace {

/// What a walk reads where there is no node.
constexpr format::TreeNode kNoNode{};

/// Compares from node `at` to the nearest leaf, `most` of them at most. With log2 of the leaves,
/// which no shortest way exceeds, it looks at as many nodes as there are.
int shortest(const format::TreeNode* nodes, int at, int most) noexcept {
  if (at < 0 || most == 0) return 0;
  return 1 + std::min(shortest(nodes, nodes[at].low, most - 1),
                      shortest(nodes, nodes[at].high, most - 1));
}

}  // namespace

HardTrees::HardTrees(const std::array<TreeView, format::kTreeAxes>& trees) noexcept
    : trees_(trees), sure_depth_(format::kMaxTreeDepth), usual_(true) {
  int depth = 0;
  for (std::size_t axis = 0; axis < trees.size(); ++axis) {
    const TreeView& tree = trees[axis];
    const bool has_nodes = tree.leaves_ > 1;
    at_root_[axis] = {has_nodes ? tree.nodes_ : &kNoNode, tree.leaves_};
    const int most = std::bit_width(static_cast<unsigned>(tree.leaves_));
    sure_depth_ = std::min(sure_depth_, shortest(tree.nodes_, has_nodes ? 0 : ~0, most));
    depth = std::max(depth, tree.depth_);
    usual_ = usual_ && !tree.empty() && tree.inputs_ == 6 && tree.degree_ == 1 &&
             tree.region_ == nullptr;
  }
  more_depth_ = depth - sure_depth_;
}

void HardTrees::evaluate(std::span<const double> u, Values& out) const noexcept {
  if (!usual_) return unusual(u, out);
  evaluate(internal::SixJoints(u.data()), u.data(), out);
}

/// Never inlined: in a function that calls, registers would be saved on the usual way too.
[[gnu::noinline]] void HardTrees::unusual(std::span<const double> u, Values& out) const noexcept {
  const Leaves at = leaves(u.data());
  out = {};
  for (std::size_t axis = 0; axis < trees_.size(); ++axis)
    out[axis] = trees_[axis].evaluate_leaf(u, static_cast<int>(at[axis].leaf()));
}

}  // namespace plumb

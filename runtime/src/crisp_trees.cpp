// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/crisp_trees.hpp"

#include <algorithm>
#include <bit>

#include "crisp_trees.hpp"

namespace plumb {
namespace {

/// The node that is read by the walks down a tree without nodes.
constexpr format::TreeNode kNoNode{};

/// The number of comparisons from node `at` to the nearest leaf, limited to `most`. With `most` =
/// log2 of the leaves, which the shortest path never exceeds, it visits no more nodes than there
/// are.
int shortest(const format::TreeNode* nodes, int at, int most) noexcept {
  if (at < 0 || most == 0) return 0;
  return 1 + std::min(shortest(nodes, nodes[at].low, most - 1),
                      shortest(nodes, nodes[at].high, most - 1));
}

}  // namespace

CrispTrees::CrispTrees(const std::array<TreeView, format::kTreeAxes>& trees) noexcept
    : trees_(trees), sure_depth_(format::kMaxTreeDepth), fast_path_(true) {
  int depth = 0;
  for (std::size_t axis = 0; axis < trees.size(); ++axis) {
    const TreeView& tree = trees[axis];
    const bool has_nodes = tree.leaves_ > 1;
    at_root_[axis] = {has_nodes ? tree.nodes_ : &kNoNode, tree.leaves_};
    const int most = std::bit_width(static_cast<unsigned>(tree.leaves_));
    sure_depth_ = std::min(sure_depth_, shortest(tree.nodes_, has_nodes ? 0 : ~0, most));
    depth = std::max(depth, tree.depth_);
    fast_path_ = fast_path_ && !tree.empty() && tree.inputs_ == 6 && tree.degree_ == 1 &&
                 tree.region_ == nullptr;
  }
  more_depth_ = depth - sure_depth_;
}

void CrispTrees::evaluate(std::span<const double> u, Values& out) const noexcept {
  if (!fast_path_) return general_path(u, out);
  evaluate(internal::SixJoints(u.data()), u.data(), out);
}

/// Kept out of line: it makes calls, for which the fast path would otherwise save registers too.
[[gnu::noinline]] void CrispTrees::general_path(std::span<const double> u,
                                                Values& out) const noexcept {
  const Leaves at = leaves(u.data());
  out = {};
  for (std::size_t axis = 0; axis < trees_.size(); ++axis)
    out[axis] = trees_[axis].evaluate_leaf(u, static_cast<int>(at[axis].leaf()));
}

}  // namespace plumb

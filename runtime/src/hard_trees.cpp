// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/hard_trees.hpp"

#include <algorithm>
#include <bit>

#include "lanes.hpp"

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
  return usual_ ? usual(u.data(), out) : unusual(u, out);
}

inline HardTrees::Leaves HardTrees::leaves(const double* u) const noexcept {
  static_assert(format::kTreeAxes == 3);
  auto [x, y, z] = at_root_;
  for (int left = sure_depth_; left > 0; --left) {
    x.step_down(u);
    y.step_down(u);
    z.step_down(u);
  }
  for (int left = more_depth_; left > 0; --left) {
    x.step(u);
    y.step(u);
    z.step(u);
  }
  return {x.leaf(), y.leaf(), z.leaf()};
}

/// Never inlined: in a function that calls, registers would be saved on the usual way too.
[[gnu::noinline]] void HardTrees::unusual(std::span<const double> u, Values& out) const noexcept {
  const Leaves at = leaves(u.data());
  for (std::size_t axis = 0; axis < trees_.size(); ++axis)
    out[axis] = trees_[axis].evaluate_leaf(u, static_cast<int>(at[axis]));
}

/// An axis a lane; each sum in the order of leaf_value.
inline void HardTrees::usual(const double* u, Values& out) const noexcept {
  constexpr std::int64_t kTerms = 7, kBounds = 2;
  const auto [i, j, k] = leaves(u);
  const double* x = trees_[0].coefficients_ + kTerms * i;
  const double* y = trees_[1].coefficients_ + kTerms * j;
  const double* z = trees_[2].coefficients_ + kTerms * k;
  const Lanes front = lanes(u), back = lanes(u + 2);
  const auto a = columns(front * lanes(x + 1), front * lanes(y + 1), front * lanes(z + 1));
  const auto b = columns(back * lanes(x + 3), back * lanes(y + 3), back * lanes(z + 3));
  const Lanes sum = Lanes{x[0], y[0], z[0], 0.0} + a[0] + a[1] + a[2] + a[3] + b[2] + b[3];
  const double* in_x = trees_[0].bounds_ + kBounds * i;
  const double* in_y = trees_[1].bounds_ + kBounds * j;
  const double* in_z = trees_[2].bounds_ + kBounds * k;
  const Lanes e =
      held(sum, Lanes{in_x[0], in_y[0], in_z[0], 0.0}, Lanes{in_x[1], in_y[1], in_z[1], 0.0});
  out = {e[0], e[1], e[2]};
}

}  // namespace plumb

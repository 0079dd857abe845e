// SPDX-License-Identifier: Apache-2.0
#include "tree_check.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::format::internal {
namespace {

using Finding = std::optional<std::string>;

constexpr double kMaxError_m = 1.0;  // no correction of an arm is larger

Finding check_sizes(const Tree& tree, std::size_t joints) {
  const std::size_t leaves = tree.bounds.size() / 2;
  if (tree.bounds.size() % 2 != 0) return "a leaf has only one bound";
  if (leaves > kMaxTreeLeaves) return "it has " + std::to_string(leaves) + " leaves";
  if (leaves == 0 && (!tree.nodes.empty() || tree.depth != 0)) return "it has nodes but no leaves";
  if (leaves > 0 && tree.nodes.size() != leaves - 1) return "nodes and leaves do not match";
  if (tree.coefficients.size() != leaves * (joints + 1))
    return "the number of coefficients is wrong";
  if (!tree.blend_half_width.empty()) return "blended trees need a newer Plumb";
  return std::nullopt;
}

Finding check_numbers(const Tree& tree) {
  for (double w : tree.coefficients)
    if (!(std::abs(w) <= kMaxError_m * 1e3)) return "a coefficient is out of range";
  for (std::size_t i = 0; i + 1 < tree.bounds.size(); i += 2) {
    const double low = tree.bounds[i], high = tree.bounds[i + 1];
    if (!(low <= high && low >= -kMaxError_m && high <= kMaxError_m))
      return "the bounds of leaf " + std::to_string(i / 2) + " are no range";
  }
  return std::nullopt;
}

/// Parents stand before their children, so one pass finds depths and proves there is no cycle.
Finding check_walk(const Tree& tree, std::size_t joints) {
  const std::size_t inner = tree.nodes.size(), leaves = inner + 1;
  std::vector<int> depth(inner, -1);
  std::vector<bool> reached(leaves, false);
  int deepest = 0;
  if (inner > 0) depth[0] = 0;
  for (std::size_t i = 0; i < inner; ++i) {
    const TreeNode& node = tree.nodes[i];
    const std::string at = "node " + std::to_string(i);
    if (depth[i] < 0) return at + " is never reached";
    if (node.input >= joints) return at + " asks for input " + std::to_string(node.input);
    if (!(std::abs(node.threshold) <= 1.0)) return at + " has a threshold outside -1 … 1";
    if (node.reserved != 0) return at + " has a reserved field that is not 0";
    for (int child : {static_cast<int>(node.low), static_cast<int>(node.high)}) {
      const auto index = static_cast<std::size_t>(child < 0 ? ~child : child);
      if (child >= 0) {
        if (index <= i || index >= inner) return at + " leads to node " + std::to_string(child);
        if (depth[index] >= 0) return "node " + std::to_string(child) + " is reached twice";
        depth[index] = depth[i] + 1;
      } else {
        if (index >= leaves) return at + " leads to leaf " + std::to_string(index);
        if (reached[index]) return "leaf " + std::to_string(index) + " is reached twice";
        reached[index] = true;
        deepest = std::max(deepest, depth[i] + 1);
      }
    }
  }
  if (deepest > kMaxTreeDepth) return "it is " + std::to_string(deepest) + " compares deep";
  if (deepest != tree.depth)
    return "its depth is " + std::to_string(deepest) + ", not " + std::to_string(tree.depth);
  return std::nullopt;
}

}  // namespace

Finding unsound_tree(const Tree& tree, std::size_t joints) {
  if (auto f = check_sizes(tree, joints)) return f;
  if (tree.bounds.empty()) return std::nullopt;
  if (auto f = check_numbers(tree)) return f;
  return check_walk(tree, joints);
}

}  // namespace plumb::format::internal

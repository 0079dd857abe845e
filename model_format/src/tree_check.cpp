// SPDX-License-Identifier: Apache-2.0
#include "tree_check.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::format::internal {
namespace {

using Finding = std::optional<std::string>;

constexpr double kMaxCorrection_m = 1.0;  // no correction of an arm is larger
/// Coefficients may be larger than the values of a leaf: where a leaf is small they cancel.
constexpr double kMaxCoefficient_m = 1e3 * kMaxCorrection_m;
constexpr double kMinHalfWidth = 1e-9;    // a half width is a divisor
constexpr double kDirectionSlack = 1e-9;  // tolerance for the sum of a direction's |numbers|
/// Limits of a region beyond this are no limits: normalised, and the trained box is -1 .. 1.
constexpr float kFarRegion = 4.0F;

Finding check_sizes(const Tree& tree, std::size_t joints) {
  const std::size_t leaves = tree.leaves(), nodes = tree.nodes.size();
  if (tree.bounds.size() % 2 != 0) return "a leaf has only one bound";
  if (leaves > kMaxTreeLeaves) return "it has " + std::to_string(leaves) + " leaves";
  if (leaves == 0 && (nodes > 0 || tree.depth != 0)) return "it has nodes but no leaves";
  if (leaves > 0 && nodes != leaves - 1) return "nodes and leaves do not match";
  if (tree.degree != 1 && tree.degree != 2)
    return "its leaves are of degree " + std::to_string(tree.degree);
  const auto size_is = [](const auto& x, std::size_t size) {
    return x.empty() || x.size() == size;
  };
  if (tree.coefficients.size() != leaves * leaf_terms(joints, tree.degree))
    return "the number of coefficients is wrong";
  if (!size_is(tree.blend_half_width, nodes)) return "the number of half widths is wrong";
  if (!size_is(tree.directions, nodes * joints)) return "the number of directions is wrong";
  if (!size_is(tree.region, leaves * joints * 2)) return "the number of region limits is wrong";
  if (!size_is(tree.sigma, leaves)) return "the number of sigmas is wrong";
  return std::nullopt;
}

Finding check_numbers(const Tree& tree) {
  for (double w : tree.coefficients)
    if (!(std::abs(w) <= kMaxCoefficient_m)) return "a coefficient is out of range";
  for (std::size_t i = 0; i + 1 < tree.bounds.size(); i += 2) {
    const double low = tree.bounds[i], high = tree.bounds[i + 1];
    if (!(low <= high && low >= -kMaxCorrection_m && high <= kMaxCorrection_m))
      return "the bounds of leaf " + std::to_string(i / 2) + " are no range";
  }
  for (double h : tree.blend_half_width)
    if (!(h >= kMinHalfWidth && h <= 2.0)) return "a half width is out of range";
  for (std::size_t i = 0; i + 1 < tree.region.size(); i += 2)
    if (!(tree.region[i] <= tree.region[i + 1] && std::abs(tree.region[i]) <= kFarRegion &&
          std::abs(tree.region[i + 1]) <= kFarRegion))
      return "the region of a leaf is no range";
  for (float sigma : tree.sigma)
    if (!(sigma >= 0.0F && sigma <= kMaxCorrection_m)) return "a sigma is out of range";
  return std::nullopt;
}

Finding check_directions(const Tree& tree, std::size_t joints) {
  for (std::size_t node = 0; node * joints < tree.directions.size(); ++node) {
    double sum = 0.0;
    for (std::size_t i = 0; i < joints; ++i) sum += std::abs(tree.directions[node * joints + i]);
    if (!(std::abs(sum - 1.0) <= kDirectionSlack))
      return "the direction of node " + std::to_string(node) + " is not of length 1";
    if (tree.nodes[node].input != 0)
      return "node " + std::to_string(node) + " has an input and a direction";
  }
  return std::nullopt;
}

/// Finds the depths of all nodes in one pass, because every parent must precede its children. That
/// also shows that there is no cycle, and that each node and leaf is reached once.
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
  if (auto f = check_directions(tree, joints)) return f;
  return check_walk(tree, joints);
}

}  // namespace plumb::format::internal

// SPDX-License-Identifier: Apache-2.0
#include "random_trees.hpp"

#include <algorithm>
#include <cmath>

#include "tests/random_numbers.hpp"

namespace plumb::tests {
namespace {

constexpr double kSize_m = 1e-3;

struct Slot {
  int parent;
  bool high;
  int depth;
};

void hang(format::Tree& tree, const Slot& slot, int child) {
  if (slot.parent < 0) return;
  auto& node = tree.nodes[static_cast<std::size_t>(slot.parent)];
  (slot.high ? node.high : node.low) = static_cast<std::int16_t>(child);
}

/// Splits a random leaf until there are enough; parents stand before children.
void grow(Random& random, const TreeKind& kind, format::Tree& tree) {
  std::vector<Slot> open{{-1, false, 0}};
  while (static_cast<int>(open.size()) < kind.leaves) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(open.size())));
    const Slot slot = open[at];
    const int index = static_cast<int>(tree.nodes.size());
    const int input = kind.oblique ? 0 : random.below(kind.joints);
    tree.nodes.push_back(
        {.threshold = random.uniform(-0.9, 0.9), .input = static_cast<std::uint16_t>(input)});
    hang(tree, slot, index);
    open[at] = {index, false, slot.depth + 1};
    open.push_back({index, true, slot.depth + 1});
  }
  for (std::size_t leaf = 0; leaf < open.size(); ++leaf) {
    hang(tree, open[leaf], ~static_cast<int>(leaf));
    tree.depth = std::max(tree.depth, static_cast<std::uint16_t>(open[leaf].depth));
  }
}

void turn(Random& random, int joints, format::Tree& tree) {
  for (std::size_t node = 0; node < tree.nodes.size(); ++node) {
    std::vector<double> d;
    double sum = 0.0;
    for (int i = 0; i < joints; ++i) d.push_back(random.uniform(-1.0, 1.0));
    for (const double x : d) sum += std::abs(x);
    for (const double x : d) tree.directions.push_back(x / sum);
  }
}

format::Tree shape(Random& random, const TreeKind& kind) {
  format::Tree out;
  grow(random, kind, out);
  if (kind.oblique) turn(random, kind.joints, out);
  const double widest = random.below(2) == 0 ? 0.3 : 1.9;
  if (kind.blended)
    for (std::size_t i = 0; i < out.nodes.size(); ++i)
      out.blend_half_width.push_back(random.uniform(1e-3, widest));
  return out;
}

/// Bounds so narrow that about every other value meets one of them.
void speak(Random& random, const TreeKind& kind, format::Tree& tree) {
  const auto joints = static_cast<std::size_t>(kind.joints);
  const auto leaves = static_cast<std::size_t>(kind.leaves);
  tree.degree = kind.quadratic ? 2 : 1;
  for (std::size_t i = 0; i < leaves * format::leaf_terms(joints, tree.degree); ++i)
    tree.coefficients.push_back(random.uniform(-kSize_m, kSize_m));
  for (std::size_t i = 0; i < leaves; ++i) {
    tree.bounds.push_back(random.uniform(-kSize_m, 0.0));
    tree.bounds.push_back(random.uniform(0.0, kSize_m));
  }
  for (std::size_t i = 0; kind.regions && i < leaves * joints; ++i) {
    tree.region.push_back(static_cast<float>(random.uniform(-1.1, -0.7)));
    tree.region.push_back(static_cast<float>(random.uniform(0.7, 1.1)));
  }
}

void set_arm(Random& random, int joints, format::Model& out) {
  for (int i = 0; i < joints; ++i) {
    format::JointRow row;
    row.name = "J" + std::to_string(i + 1);
    row.type = static_cast<format::JointType>(random.below(2));
    row.q_min = -6.0;
    row.q_max = 6.0;
    out.calibrated.joints.push_back(row);
    out.domain.q_min.push_back(random.uniform(-5.0, -0.1));
    out.domain.q_max.push_back(random.uniform(0.1, 5.0));
  }
  out.nominal = out.calibrated;
  out.domain.fade = random.uniform(0.01, 1.0);
}

}  // namespace

TreeKind kind_number(int k, std::uint64_t seed) {
  Random random(seed);
  const int sizes[] = {1, 150, 150};
  TreeKind out{.joints = 1 + random.below(format::kMaxJoints),
               .leaves = random.below(3) == 0 ? sizes[random.below(3)] : 2 + random.below(40)};
  bool* const switches[] = {&out.blended, &out.quadratic, &out.oblique,
                            &out.regions, &out.shared,    &out.one_axis};
  for (int i = 0; i < 6; ++i) *switches[i] = (k >> i) % 2 == 1;
  return out;
}

format::Model random_tree_model(const TreeKind& kind, std::uint64_t seed) {
  Random random(seed);
  format::Model out;
  out.cell_name = "Cell";
  out.robot_name = "Robot";
  out.serial = std::to_string(seed);
  out.provenance.tool_version = "0.0.0";
  out.provenance.created = "2026-01-01T00:00:00Z";
  out.provenance.poses_fit = 100;
  out.provenance.held_out = {20, 1.25e-5, 1.5e-5, 3e-5, 4e-5};
  set_arm(random, kind.joints, out);
  const format::Tree first = shape(random, kind);
  for (std::size_t axis = 0; axis < out.trees.size(); ++axis) {
    if (kind.one_axis && axis != 1) continue;
    out.trees[axis] = kind.shared ? first : shape(random, kind);
    speak(random, kind, out.trees[axis]);
  }
  return out;
}

}  // namespace plumb::tests

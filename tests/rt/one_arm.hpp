// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::tests {

/// A UR10-like arm with errors of half a millimetre and a small tree on every axis.
inline format::Model one_arm() {
  constexpr double kQuarterTurn = 0.5 * std::numbers::pi;
  const double alpha[] = {kQuarterTurn, 0.0, 0.0, kQuarterTurn, -kQuarterTurn, 0.0};
  const double a[] = {0.0, -0.612, -0.5723, 0.0, 0.0, 0.0};
  const double d[] = {0.1273, 0.0, 0.0, 0.163941, 0.1157, 0.0922};
  format::Model model;
  for (int i = 0; i < 6; ++i) {
    format::JointRow row;
    row.name = "J" + std::to_string(i + 1);
    row.alpha = alpha[i];
    row.a = a[i];
    row.d = d[i];
    row.q_min = -2.0 * std::numbers::pi;
    row.q_max = 2.0 * std::numbers::pi;
    model.nominal.joints.push_back(row);
    row.alpha += 3e-4;
    row.a += 5e-4;
    row.theta -= 2e-4;
    model.calibrated.joints.push_back(row);
    model.domain.q_min.push_back(-3.0);
    model.domain.q_max.push_back(3.0);
  }
  format::Tree tree;
  tree.depth = 2;
  tree.nodes = {{0.25, 1, ~0, 1, 0}, {-0.5, 2, ~1, ~2, 0}};
  for (int leaf = 0; leaf < 3; ++leaf) {
    tree.coefficients.push_back(1e-5 * leaf);
    for (int i = 0; i < 6; ++i) tree.coefficients.push_back(2e-6 * (i - leaf));
    tree.bounds.insert(tree.bounds.end(), {-5e-5, 5e-5});
  }
  model.trees.fill(tree);
  return model;
}

/// The same with three quadratic leaves along directions on every axis, blended over most of the
/// box, each with a region; the axes share their leaves, and the bounds hold the sum softly.
inline format::Model blended_arm() {
  format::Model model = one_arm();
  format::Tree tree;
  tree.depth = 2;
  tree.degree = 2;
  tree.nodes = {{0.25, 0, ~0, 1, 0}, {-0.5, 0, ~1, ~2, 0}};
  tree.blend_half_width = {0.75, 0.3};
  tree.directions = {0.5, 0.25, 0.0, 0.125, 0.0, 0.125, 0.1, -0.2, 0.3, 0.2, -0.1, 0.1};
  for (int leaf = 0; leaf < 3; ++leaf) {
    for (int i = 0; i < 28; ++i) tree.coefficients.push_back(3e-6 * ((i + leaf) % 7 - 3));
    tree.bounds.insert(tree.bounds.end(), {-3e-5 + 1e-6 * leaf, 3e-5});
    for (int i = 0; i < 6; ++i) tree.region.insert(tree.region.end(), {-0.95F, 0.9F});
  }
  for (std::size_t axis = 0; axis < model.trees.size(); ++axis) {
    model.trees[axis] = tree;
    for (double& w : model.trees[axis].coefficients) w *= 1.0 - 0.25 * static_cast<double>(axis);
  }
  return model;
}

}  // namespace plumb::tests

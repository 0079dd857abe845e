// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::tests {

/// A balanced crisp tree over all joints.
inline format::Tree balanced_tree(int leaves, int joints) {
  format::Tree tree;
  for (int i = 0; i + 1 < leaves; ++i) {
    const auto child = [&](int k) {
      return static_cast<std::int16_t>(k < leaves - 1 ? k : ~(k - leaves + 1));
    };
    tree.nodes.push_back({.threshold = 0.1 * (i % 7) - 0.3,
                          .input = static_cast<std::uint16_t>(i % joints),
                          .low = child(2 * i + 1),
                          .high = child(2 * i + 2)});
  }
  for (int width = 1; width < leaves; width *= 2) ++tree.depth;
  for (int i = 0; i < leaves * (joints + 1); ++i) tree.coefficients.push_back(1e-5 * (i % 11 - 5));
  for (int i = 0; i < leaves; ++i) tree.bounds.insert(tree.bounds.end(), {-1e-4, 1e-4});
  return tree;
}

/// Six effects as a diagnosis finds them on a heavy arm.
inline std::vector<format::Effect> six_effects() {
  using format::ContextInput;
  const std::vector<format::ContextNeed> direction{{ContextInput::kDirection, "", 0.0}};
  const std::vector<format::ContextNeed> payload{{ContextInput::kPayload, "", 5.0}};
  std::vector<format::Effect> out(6);
  out[0] = {
      .name = "joint_compliance", .joints = {1, 2}, .parameters = {2e-6, 3e-6}, .context = {}};
  out[1] = {.name = "gear_ripple",
            .joints = {1},
            .parameters = {8e-5, -5e-5},
            .context = {},
            .constants = {17.0}};
  out[2] = {.name = "reversal",
            .joints = {0, 1},
            .parameters = {6e-5, 8e-5},
            .context = direction,
            .constants = {0.01}};
  out[3] = {
      .name = "wrist_coupling", .joints = {}, .parameters = {1e-4, -5e-5, 2e-4}, .context = {}};
  out[4] = {.name = "base_compliance",
            .joints = {},
            .parameters = {1e-7, 1e-7, 0.0, 0.0, 0.0, 0.0},
            .context = {}};
  out[5] = {.name = "tool_sag",
            .joints = {},
            .parameters = {1e-6, 0.0, 0.0, 0.0, 1e-6, 0.0, 0.0, 0.0, 5e-7},
            .context = payload};
  return out;
}

/// What budgets are judged on: six joints, six effects, three trees of 100 leaves.
inline format::Model cycle_model() {
  format::Model model = one_arm();
  for (auto& tree : model.trees) tree = balanced_tree(100, 6);
  model.trees[1].nodes[0].threshold = 0.05;  // so that the three share no walk
  model.trees[2].nodes[0].threshold = -0.05;
  for (int j = 0; j < 6; ++j) model.mechanics.links.push_back({30.0 - 5.0 * j, {0.1, 0.0, 0.05}});
  model.mechanics.payload_kg = 5.0;
  model.mechanics.payload_com_m = {0.0, 0.0, 0.1};
  model.effects = six_effects();
  return model;
}

}  // namespace plumb::tests

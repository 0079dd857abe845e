// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tests/bench/study_data.hpp"
#include "tests/tree/tree_data.hpp"
#include "tree/blended_path.hpp"
#include "tree/growth.hpp"

/// The trees whose evaluation is timed and counted: grown, not made up, so unbalanced as in use.
namespace plumb::offline::bench {

inline constexpr int kSixJoints = 6;
inline constexpr int kCrispLeaves = 100;
inline constexpr int kStudyLeaves = 93;
inline constexpr double kStudyRidge = 1e-10;

/// Crisp, six joints, a tree an axis, no split in common.
inline std::array<format::Tree, 3> crisp_trees() {
  Random random(1);
  const Samples u = tree_data::uniform(4000, kSixJoints, -1.0, 1.0, random);
  std::array<format::Tree, 3> out;
  for (int axis = 0; axis < 3; ++axis) {
    const Samples y = tree_data::smooth(u.array() * (1.0 - 0.3 * axis), 1e-4);
    out[axis] = grow(u, y, {.max_leaves = kCrispLeaves}).cut(kCrispLeaves);
  }
  return out;
}

/// A model of nothing but those trees over the box -1 .. 1, so that u = q.
inline format::Model crisp_model() {
  format::Model model;
  model.trees = crisp_trees();
  model.calibrated.joints.resize(kSixJoints);
  model.domain.q_min.assign(kSixJoints, -1.0);
  model.domain.q_max.assign(kSixJoints, 1.0);
  return model;
}

/// Blended, x and y on the same splits.
inline std::vector<format::Tree> blended_trees(const Data& data) {
  BlendSettings settings;
  settings.growth.max_leaves = kStudyLeaves;
  BlendedPath path(data.u, data.y, settings);
  path.grow_to(kStudyLeaves);
  return path.solve(kStudyRidge);
}

/// Uniform in the box, one row an input of the tree.
template <int kInputs>
std::vector<std::array<double, kInputs>> random_inputs(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::array<double, kInputs>> out(static_cast<std::size_t>(count));
  for (auto& u : out)
    for (double& x : u) x = 2.0 * random.unit() - 1.0;
  return out;
}

}  // namespace plumb::offline::bench

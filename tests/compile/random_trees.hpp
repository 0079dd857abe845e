// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/format/model.hpp"

namespace plumb::tests {

/// What a model's trees are to be like.
struct TreeKind {
  int joints = 6;        // 1 .. 9
  int leaves = 20;       // 1 .. kMaxTreeLeaves
  bool blended = false;  // every other one so widely that more than kMaxActiveLeaves meet
  bool quadratic = false;
  bool oblique = false;
  bool regions = false;
  bool shared = false;    // the axes cut the domain in the same way
  bool one_axis = false;  // x and z have no tree
};

/// All 64 ways to set the switches, `seed` giving joints and leaves.
TreeKind kind_number(int k, std::uint64_t seed);

/// A sound model of that kind; the same for the same seed.
format::Model random_tree_model(const TreeKind& kind, std::uint64_t seed);

}  // namespace plumb::tests

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lane_choices.hpp"
#include "lane_order.hpp"
#include "lanes.hpp"
#include "plumb/runtime/detail/crisp_trees.hpp"
#include "six_joints.hpp"

/// The inline functions of CrispTrees: walking down and evaluating the leaves.
namespace plumb {

[[gnu::always_inline]] inline CrispTrees::Leaves CrispTrees::leaves(
    const double* u) const noexcept {
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
  return {x, y, z};
}

/// Computes one axis per lane, each sum in the order of TreeView::leaf_value. The third input is in
/// `front` and again in `back`, so its second product, b[0], is not added.
[[gnu::always_inline]] inline void CrispTrees::evaluate(const internal::SixJoints& u,
                                                        const double* looked_up,
                                                        Values& out) const noexcept {
  constexpr std::int64_t kTerms = 7, kBounds = 2;  // numbers of an affine leaf of six inputs
  const auto [i, j, k] = leaves(looked_up);
  const double* x = i.row(trees_[0].coefficients_, kTerms);
  const double* y = j.row(trees_[1].coefficients_, kTerms);
  const double* z = k.row(trees_[2].coefficients_, kTerms);
  const Lanes front = behind_one(u.front()), back = u.back();
  const auto a = columns(front * lanes(x), front * lanes(y), front * lanes(z));
  const auto b = columns(back * lanes(x + 3), back * lanes(y + 3), back * lanes(z + 3));
  const Lanes sum = a[0] + a[1] + a[2] + a[3] + b[1] + b[2] + b[3];
  const auto [low, high] =
      columns_of_two(i.row(trees_[0].bounds_, kBounds), j.row(trees_[1].bounds_, kBounds),
                     k.row(trees_[2].bounds_, kBounds));
  store(clamped(sum, low, high), out.data());
}

}  // namespace plumb

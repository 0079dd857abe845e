// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb {

/// Trained joint domain: normalises the trees' inputs and says how far to trust them.
class TrainedDomain {
 public:
  TrainedDomain() = default;
  explicit TrainedDomain(const format::Domain& domain) noexcept;

  /// u_i in [-1, 1] inside the box; clamped to the box outside. Shape (n,) each.
  void normalise(std::span<const double> q, std::span<double> u) const noexcept;

  /// 1 inside the box, falling linearly to 0 at `fade` spans outside it (worst joint counts).
  double weight(std::span<const double> q) const noexcept;

 private:
  int joints_ = 0;
  double fade_inverse_ = 0.0;
  std::array<double, format::kMaxJoints> mid_{};
  std::array<double, format::kMaxJoints> half_inverse_{};
};

/// Evaluates one tree of a verified model, [Nelles 2000] eq. (1) with crisp validity.
/// Refers to the model's memory: the model must outlive it.
class TreeView {
 public:
  TreeView() = default;
  explicit TreeView(const format::Tree& tree, int inputs) noexcept;

  bool empty() const noexcept { return leaves_ == 0; }

  /// Leaf that u, shape (n,), falls into. Cost: exactly `depth` compares, whatever u is.
  int leaf(std::span<const double> u) const noexcept;

  /// Error along the tree's axis [m], clamped to what the leaf saw in training; 0 if empty.
  double evaluate(std::span<const double> u) const noexcept;

 private:
  const format::TreeNode* nodes_ = nullptr;
  const double* coefficients_ = nullptr;
  const double* bounds_ = nullptr;
  int inputs_ = 0;
  int depth_ = 0;
  int leaves_ = 0;
};

}  // namespace plumb

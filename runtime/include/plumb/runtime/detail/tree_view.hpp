// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"

namespace plumb {

/// The leaves that contribute to a value, with their weights, which are > 0 and add up to 1.
template <class Scalar>
struct ActiveLeaves {
  int count = 0;
  std::array<int, format::kMaxActiveLeaves> leaf;
  std::array<Scalar, format::kMaxActiveLeaves> weight;
};

/// Outside the regions of its leaves a value fades to zero over this distance of the normalised
/// input: it is multiplied by sum_k Phi_k prod_i (3 s_i^2 - 2 s_i^3), where s_i falls linearly from
/// 1 to 0.
inline constexpr double kRegionFade = 0.1;

/// A blended sum exceeds the range of errors seen in training by at most this share of the range.
inline constexpr double kSoftShare = 0.1;

/// Evaluates one tree of a verified model as format::Tree defines it. Refers to the model's memory:
/// the model must outlive it. Scalar is double in the cycle; offline it is also a type that carries
/// derivatives. u: normalised inputs, shape (n,), clamped to the box.
///
/// Cost of a crisp tree: exactly `depth` comparisons and one leaf, whatever u is. Of a blended
/// tree: at most kMaxActiveLeaves leaves and `depth` times as many nodes. Wait-free; any thread.
class TreeView {
 public:
  TreeView() = default;
  explicit TreeView(const format::Tree& tree, int inputs) noexcept;

  bool empty() const noexcept { return leaves_ == 0; }
  bool blended() const noexcept { return half_width_ != nullptr; }

  /// True if both trees have the same nodes, so that one walk finds the leaves of both.
  bool same_leaves(const TreeView& other) const noexcept;

  /// Leaf whose cell contains u, as if the tree were crisp.
  int leaf(std::span<const double> u) const noexcept;

  /// Finds the leaves that contribute at u; a crisp tree has one, of weight 1. If there would be
  /// more than kMaxActiveLeaves, which the trainer avoids, the further nodes are treated as crisp.
  template <class Scalar>
  void active(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept;

  /// Error along the tree's axis [m]. It stays within the range seen in training, fades out outside
  /// the regions of the leaves, and is 0 for an empty tree.
  template <class Scalar>
  Scalar evaluate(std::span<const Scalar> u) const noexcept;

  /// The same with leaves that active() found before.
  template <class Scalar>
  Scalar evaluate(std::span<const Scalar> u, const ActiveLeaves<Scalar>& active) const noexcept;

  double evaluate(std::span<const double> u) const noexcept { return evaluate<double>(u); }

  /// True if CrispTrees can evaluate it: it is crisp and split along the axes, or empty.
  bool hard() const noexcept { return !blended() && directions_ == nullptr; }

  /// Standard deviation of the error of evaluate() on held-out poses of the training [m]; 0 if
  /// unknown.
  double sigma(std::span<const double> u) const noexcept;

 private:
  friend class CrispTrees;
  double evaluate_leaf(std::span<const double> u, int leaf) const noexcept;
  template <bool kOblique, class Scalar>
  Scalar split_value(std::span<const Scalar> u, int node) const noexcept;
  template <int kInputs, class Scalar>
  Scalar leaf_value(std::span<const Scalar> u, int leaf) const noexcept;
  template <int kInputs, class Scalar>
  Scalar sum(std::span<const Scalar> u, const ActiveLeaves<Scalar>& active) const noexcept;
  template <class Scalar>
  Scalar trust(std::span<const Scalar> u, int leaf) const noexcept;
  template <bool kOblique, class Scalar>
  void walk(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept;
  template <bool kOblique, class Scalar>
  int step(std::span<const Scalar> u, int at) const noexcept;
  template <bool kOblique, class Scalar>
  int hard_leaf(std::span<const Scalar> u) const noexcept;

  const format::TreeNode* nodes_ = nullptr;
  const double* coefficients_ = nullptr;
  const double* bounds_ = nullptr;
  const double* half_width_ = nullptr;
  const double* directions_ = nullptr;
  const float* region_ = nullptr;
  const float* sigma_ = nullptr;
  int inputs_ = 0;
  int terms_ = 0;
  int degree_ = 1;
  int depth_ = 0;
  int leaves_ = 0;
};

/// Fills in the terms that the coefficients of a leaf multiply: 1, u_i, and for degree 2 the
/// products u_i u_k with i <= k. out: shape (leaf_terms(n, degree),).
template <class Scalar>
void fill_leaf_terms(std::span<const Scalar> u, int degree, std::span<Scalar> out) noexcept {
  std::size_t next = 0;
  out[next++] = Scalar(1.0);
  for (const Scalar& x : u) out[next++] = x;
  if (degree < 2) return;
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t k = i; k < u.size(); ++k) out[next++] = u[i] * u[k];
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb {
namespace internal {
struct SixJoints;  // a number of each, in registers
}

/// Trained joint domain: normalises the trees' inputs and says how far to trust them.
class TrainedDomain {
 public:
  TrainedDomain() = default;
  explicit TrainedDomain(const format::Domain& domain) noexcept;

  /// u_i in [-1, 1] inside the box; clamped to the box outside. Shape (n,) each.
  /// Returns how far to trust the trees: 1 inside the box, falling linearly to 0 at `fade` spans
  /// outside it (worst joint counts).
  double normalise(std::span<const double> q, std::span<double> u) const noexcept;

  /// The same of six joints, for the library alone.
  double normalise(const internal::SixJoints& q, internal::SixJoints& u) const noexcept;

 private:
  static constexpr std::size_t kRoom = 12;  // joints, in whole registers

  int joints_ = 0;
  double fade_inverse_ = 0.0;
  std::array<double, kRoom> mid_{};
  std::array<double, kRoom> half_inverse_{};
};

/// Leaves that have a say, and how much: weights > 0 that add up to 1.
template <class Scalar>
struct ActiveLeaves {
  int count = 0;
  std::array<int, format::kMaxActiveLeaves> leaf;
  std::array<Scalar, format::kMaxActiveLeaves> weight;
};

/// What is said fades to zero over this distance outside the regions of the leaves that say it,
/// normalised input: the sum is multiplied by sum_k Phi_k prod_i (3 s_i^2 - 2 s_i^3), s_i falling
/// from 1 to 0.
inline constexpr double kRegionFade = 0.1;

/// A blended sum leaves the range that its leaves saw by at most this share of it.
inline constexpr double kSoftShare = 0.1;

/// Evaluates one tree of a verified model as format::Tree defines it. Refers to the model's memory:
/// the model must outlive it. Scalar: double in the cycle; offline also numbers with derivatives,
/// which is where its Jacobian comes from. u: normalised inputs, shape (n,), clamped to the box.
///
/// Cost, crisp: exactly `depth` compares and one leaf, whatever u is. Blended: at most
/// kMaxActiveLeaves leaves and depth times as many nodes. Wait-free; any thread.
class TreeView {
 public:
  TreeView() = default;
  explicit TreeView(const format::Tree& tree, int inputs) noexcept;

  bool empty() const noexcept { return leaves_ == 0; }
  bool blended() const noexcept { return half_width_ != nullptr; }

  /// Whether the leaves of both are the same, so that one walk serves both.
  bool same_leaves(const TreeView& other) const noexcept;

  /// Leaf whose hard cell u falls into.
  int leaf(std::span<const double> u) const noexcept;

  /// One leaf with weight 1 if crisp. Where more than kMaxActiveLeaves would have a say, which the
  /// trainer avoids, further nodes are crisp.
  template <class Scalar>
  void active(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept;

  /// Error along the tree's axis [m], held within what was seen, fading out outside the leaves'
  /// regions; 0 if empty.
  template <class Scalar>
  Scalar evaluate(std::span<const Scalar> u) const noexcept;

  /// The same for leaves found before.
  template <class Scalar>
  Scalar evaluate(std::span<const Scalar> u, const ActiveLeaves<Scalar>& active) const noexcept;

  double evaluate(std::span<const double> u) const noexcept { return evaluate<double>(u); }

  /// Crisp along the axes, or empty: HardTrees serves it.
  bool hard() const noexcept { return !blended() && directions_ == nullptr; }

  /// 1 sigma of the error of `evaluate` as the trainer saw it on held-out poses [m]; 0 if unknown.
  double sigma(std::span<const double> u) const noexcept;

 private:
  friend class HardTrees;
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

/// What a leaf's coefficients multiply: 1, u_i, and for degree 2 the products u_i u_k, i <= k.
/// out: shape (leaf_terms(n, degree),).
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

#include "plumb/runtime/tree_walk.hpp"

namespace plumb {

extern template void TreeView::active(std::span<const double>,
                                      ActiveLeaves<double>&) const noexcept;
extern template double TreeView::evaluate(std::span<const double>,
                                          const ActiveLeaves<double>&) const noexcept;
extern template double TreeView::evaluate<double>(std::span<const double>) const noexcept;

}  // namespace plumb

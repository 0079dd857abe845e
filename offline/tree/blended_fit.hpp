// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "plumb/format/model.hpp"
#include "tree/samples.hpp"

namespace plumb::offline {

/// All leaf coefficients of a blended tree in one least squares over all samples:
///   min sum_i (y_i - sum_k Phi_k(u_i) y_k(u_i))^2 + ridge n / leaves sum_k |c_k|^2
/// where c_k are the coefficients of leaf k minus those of one model for the whole box, in inputs
/// that are centred and scaled to the region where the leaf is active. With a large ridge the tree
/// becomes that one model.
/// The normal matrix couples only leaves that are active at the same point, so it is sparse.
///
/// It is set up once for a tree and its samples, and can be solved for any number of outputs and
/// ridges.
/// Cost: samples x (active terms)^2 / 2 to set up; a sparse or, below a thousand or so unknowns, a
/// dense Cholesky factorisation a ridge.
class BlendedFit {
 public:
  /// tree: with half widths; u: (n, p).
  BlendedFit(const format::Tree& tree, const Samples& u);
  ~BlendedFit();
  BlendedFit(const BlendedFit&) = delete;
  BlendedFit& operator=(const BlendedFit&) = delete;

  /// The tree with new coefficients and bounds for every column of y, shape (n, outputs) [m].
  /// The bounds of a leaf are the range of y where it is active, widened by 2 / sqrt(samples) of
  /// that range, at most by a quarter, because between the samples and in the corners the true
  /// values exceed the range that was seen.
  std::vector<format::Tree> solve(const Samples& y, double ridge) const;

  /// The same with each leaf fitted alone to the samples weighted by its validity, as LOLIMOT does
  /// [Nelles 2000]. Used for comparison.
  std::vector<format::Tree> solve_locally(const Samples& y) const;

  int unknowns() const;

 private:
  struct Design;
  std::unique_ptr<Design> design_;
};

/// The smallest ridge that is used; smaller ones change the result by rounding errors only.
inline constexpr double kLeastRidge = 1e-12;

}  // namespace plumb::offline

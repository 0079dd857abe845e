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
/// where c_k are leaf k's coefficients less those of one model for the whole box, in inputs centred
/// and scaled to where the leaf has a say: with a large ridge the tree is that one model.
/// The normal matrix couples only leaves that have a say together, so it is sparse.
///
/// Made once for a tree and its samples; solved for as many outputs and ridges as wanted.
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
  /// bounds: what was seen where a leaf has a say, and 2 / sqrt(samples) of that range more, at
  /// most a quarter: between the samples, and in the corners, the truth goes further.
  std::vector<format::Tree> solve(const Samples& y, double ridge) const;

  /// The same with each leaf fitted by itself to the samples weighted by its validity: the textbook
  /// LOLIMOT way [Nelles 2000], for comparison.
  std::vector<format::Tree> solve_locally(const Samples& y) const;

  int unknowns() const;

 private:
  struct Design;
  std::unique_ptr<Design> design_;
};

/// Smallest ridge that is used: below it nothing changes but rounding.
inline constexpr double kLeastRidge = 1e-12;

}  // namespace plumb::offline

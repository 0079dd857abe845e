// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/tree.hpp"

#include <algorithm>

namespace plumb {
namespace {

double clamp(double x, double low, double high) noexcept {
  // Written so that NaN gives `low`, never an index or a bound of its own.
  return x > low ? (x < high ? x : high) : low;
}

}  // namespace

TrainedDomain::TrainedDomain(const format::Domain& domain) noexcept
    : joints_(std::min(static_cast<int>(domain.q_min.size()), format::kMaxJoints)),
      fade_inverse_(1.0 / (2.0 * domain.fade)) {
  for (int i = 0; i < joints_; ++i) {
    mid_[i] = 0.5 * (domain.q_min[i] + domain.q_max[i]);
    half_inverse_[i] = 2.0 / (domain.q_max[i] - domain.q_min[i]);
  }
}

void TrainedDomain::normalise(std::span<const double> q, std::span<double> u) const noexcept {
  for (int i = 0; i < joints_; ++i) u[i] = clamp((q[i] - mid_[i]) * half_inverse_[i], -1.0, 1.0);
}

double TrainedDomain::weight(std::span<const double> q) const noexcept {
  double excess = 0.0;  // in half spans
  for (int i = 0; i < joints_; ++i) {
    const double u = (q[i] - mid_[i]) * half_inverse_[i];
    excess = std::max(excess, std::max(u - 1.0, -1.0 - u));
  }
  return clamp(1.0 - excess * fade_inverse_, 0.0, 1.0);
}

TreeView::TreeView(const format::Tree& tree, int inputs) noexcept
    : nodes_(tree.nodes.data()),
      coefficients_(tree.coefficients.data()),
      bounds_(tree.bounds.data()),
      inputs_(inputs),
      depth_(tree.depth),
      leaves_(static_cast<int>(tree.bounds.size() / 2)) {}

int TreeView::leaf(std::span<const double> u) const noexcept {
  int at = leaves_ > 1 ? 0 : ~0;
  for (int i = 0; i < depth_; ++i) {
    // In a leaf the walk stands still: the root is read again and its answer dropped.
    const format::TreeNode& node = nodes_[at < 0 ? 0 : at];
    const int next = u[node.input] <= node.threshold ? node.low : node.high;
    at = at < 0 ? at : next;
  }
  return ~at;
}

double TreeView::evaluate(std::span<const double> u) const noexcept {
  if (empty()) return 0.0;
  const int k = leaf(u);
  const double* w = coefficients_ + static_cast<std::ptrdiff_t>(k) * (inputs_ + 1);
  double y = w[0];
  for (int i = 0; i < inputs_; ++i) y += w[i + 1] * u[i];
  return clamp(y, bounds_[2 * k], bounds_[2 * k + 1]);
}

}  // namespace plumb

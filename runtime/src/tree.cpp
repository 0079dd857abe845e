// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/tree.hpp"

namespace plumb {
namespace {

double clamp(double x, double low, double high) noexcept {
  // Written so that NaN gives `low`, never an index or a bound of its own; and without a branch.
  const double up = x > low ? x : low;
  return up < high ? up : high;
}

}  // namespace

template void TreeView::active(std::span<const double>, ActiveLeaves<double>&) const noexcept;
template double TreeView::evaluate(std::span<const double>,
                                   const ActiveLeaves<double>&) const noexcept;
template double TreeView::evaluate<double>(std::span<const double>) const noexcept;

TreeView::TreeView(const format::Tree& tree, int inputs) noexcept
    : nodes_(tree.nodes.data()),
      coefficients_(tree.coefficients.data()),
      bounds_(tree.bounds.data()),
      half_width_(tree.blend_half_width.empty() ? nullptr : tree.blend_half_width.data()),
      directions_(tree.directions.empty() ? nullptr : tree.directions.data()),
      region_(tree.region.empty() ? nullptr : tree.region.data()),
      sigma_(tree.sigma.empty() ? nullptr : tree.sigma.data()),
      inputs_(inputs),
      terms_(static_cast<int>(format::leaf_terms(static_cast<std::size_t>(inputs), tree.degree))),
      degree_(tree.degree),
      depth_(tree.depth),
      leaves_(static_cast<int>(tree.leaves())) {}

bool TreeView::same_leaves(const TreeView& other) const noexcept {
  if (leaves_ != other.leaves_ || inputs_ != other.inputs_ || depth_ != other.depth_) return false;
  if (blended() != other.blended()) return false;
  if ((directions_ == nullptr) != (other.directions_ == nullptr)) return false;
  for (int i = 0; i + 1 < leaves_; ++i) {
    if (!(nodes_[i] == other.nodes_[i])) return false;
    if (blended() && half_width_[i] != other.half_width_[i]) return false;
  }
  const int numbers = directions_ == nullptr ? 0 : (leaves_ - 1) * inputs_;
  for (int i = 0; i < numbers; ++i)
    if (directions_[i] != other.directions_[i]) return false;
  return true;
}

int TreeView::leaf(std::span<const double> u) const noexcept {
  return directions_ != nullptr ? hard_leaf<true>(u) : hard_leaf<false>(u);
}

double TreeView::evaluate_leaf(std::span<const double> u, int leaf) const noexcept {
  if (empty()) return 0.0;
  const double y = inputs_ == 6 ? leaf_value<6>(u, leaf) : leaf_value<0>(u, leaf);
  const double held = clamp(y, bounds_[2 * leaf], bounds_[2 * leaf + 1]);
  return region_ == nullptr ? held : held * trust(u, leaf);
}

double TreeView::sigma(std::span<const double> u) const noexcept {
  if (empty() || sigma_ == nullptr) return 0.0;
  ActiveLeaves<double> leaves;
  active(u, leaves);
  double out = 0.0;
  for (int i = 0; i < leaves.count; ++i)
    out += leaves.weight[i] * static_cast<double>(sigma_[leaves.leaf[i]]);
  return out;
}

}  // namespace plumb

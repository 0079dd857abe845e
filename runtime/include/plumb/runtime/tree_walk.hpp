// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

#include "plumb/runtime/plain.hpp"
#include "plumb/runtime/tree.hpp"

/// Bodies of TreeView's templates.
namespace plumb {
namespace internal {

template <class Scalar>
struct OpenNode {
  int node;
  Scalar weight;
};

/// Identity in [low, high], C1 beyond it, never further out than kSoftShare of the range:
/// t -> m t / (m + t).
template <class Scalar>
Scalar hold_softly(const Scalar& y, const Scalar& low, const Scalar& high) noexcept {
  const Scalar margin = (high - low) * kSoftShare;
  if (plain(y) > plain(high)) return high + margin * (y - high) / (margin + (y - high));
  if (plain(y) < plain(low)) return low - margin * (low - y) / (margin + (low - y));
  return y;
}

}  // namespace internal

template <class Scalar>
Scalar TreeView::split_value(std::span<const Scalar> u, int node) const noexcept {
  if (directions_ == nullptr) return u[nodes_[node].input];
  const double* d = directions_ + static_cast<std::ptrdiff_t>(node) * inputs_;
  Scalar sum = u[0] * d[0];
  for (int i = 1; i < inputs_; ++i) sum = sum + u[i] * d[i];
  return sum;
}

template <class Scalar>
int TreeView::hard_leaf(std::span<const Scalar> u) const noexcept {
  int at = leaves_ > 1 ? 0 : ~0;
  for (int i = 0; i < depth_; ++i) {
    // In a leaf the walk stands still: the root is read again and its answer dropped.
    const int node = at < 0 ? 0 : at;
    const bool low = plain(split_value(u, node)) <= nodes_[node].threshold;
    const int next = low ? nodes_[node].low : nodes_[node].high;
    at = at < 0 ? at : next;
  }
  return ~at;
}

/// Level by level; a child is always written and counted only if it belongs there.
template <class Scalar>
void TreeView::walk(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept {
  constexpr int kRoom = format::kMaxActiveLeaves;
  using Open = internal::OpenNode<Scalar>;
  std::array<std::array<Open, kRoom + 1>, 2> levels;
  Open *here = levels[0].data(), *below = levels[1].data();
  int open = 0;
  const auto put = [&](int child, const Scalar& weight) {
    const bool wanted = plain(weight) > 0.0;
    out.leaf[out.count] = ~child;
    out.weight[out.count] = weight;
    below[open] = {child, weight};
    out.count += static_cast<int>(wanted && child < 0);
    open += static_cast<int>(wanted && child >= 0);
  };
  put(leaves_ > 1 ? 0 : ~0, Scalar(1.0));
  while (open > 0) {
    const int now = open;
    std::swap(here, below);
    open = 0;
    for (int i = 0; i < now; ++i) {
      const Open at = here[i];
      const format::TreeNode& node = nodes_[at.node];
      const double h = half_width_[at.node];
      Scalar s = (split_value(u, at.node) - (node.threshold - h)) / (2.0 * h);
      s = plain(s) > 0.0 ? (plain(s) < 1.0 ? s : Scalar(1.0)) : Scalar(0.0);
      const bool full = out.count + open + (now - i) >= kRoom;
      if (full) s = plain(s) > 0.5 ? Scalar(1.0) : Scalar(0.0);
      const Scalar high = at.weight * (s * s * (3.0 - 2.0 * s));
      put(node.low, at.weight - high);
      put(node.high, high);
    }
  }
}

template <class Scalar>
void TreeView::active(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept {
  out.count = 0;
  if (empty()) return;
  if (blended()) return walk(u, out);
  out.count = 1;
  out.leaf[0] = hard_leaf(u);
  out.weight[0] = Scalar(1.0);
}

/// Product over the inputs of 3 s^2 - 2 s^3, s falling from 1 to 0 over kRegionFade outside.
template <class Scalar>
Scalar TreeView::trust(std::span<const Scalar> u, int leaf) const noexcept {
  const float* region = region_ + static_cast<std::ptrdiff_t>(leaf) * inputs_ * 2;
  Scalar out(1.0);
  for (int i = 0; i < inputs_; ++i) {
    const double low = region[2 * i], high = region[2 * i + 1];
    const double at = plain(u[i]);
    const Scalar excess = at > high ? u[i] - high : at < low ? low - u[i] : Scalar(0.0);
    const Scalar s = plain(excess) < kRegionFade ? 1.0 - excess / kRegionFade : Scalar(0.0);
    out = out * (s * s * (3.0 - 2.0 * s));
  }
  return out;
}

template <class Scalar>
Scalar TreeView::evaluate(std::span<const Scalar> u,
                          const ActiveLeaves<Scalar>& active) const noexcept {
  if (empty()) return Scalar(0.0);
  std::array<Scalar, format::kMaxLeafTerms> terms;
  fill_leaf_terms<Scalar>(u.first(static_cast<std::size_t>(inputs_)), degree_, terms);
  Scalar y(0.0), low(0.0), high(0.0), trusted(region_ == nullptr ? 1.0 : 0.0);
  for (int i = 0; i < active.count; ++i) {
    const int k = active.leaf[i];
    const double* w = coefficients_ + static_cast<std::ptrdiff_t>(k) * terms_;
    Scalar value(w[0]);
    for (int t = 1; t < terms_; ++t) value = value + terms[t] * w[t];
    y = y + active.weight[i] * value;
    low = low + active.weight[i] * bounds_[2 * k];
    high = high + active.weight[i] * bounds_[2 * k + 1];
    if (region_ != nullptr) trusted = trusted + active.weight[i] * trust(u, k);
  }
  if (blended()) return internal::hold_softly(y, low, high) * trusted;
  // Written so that NaN gives `low`.
  return (plain(y) > plain(low) ? (plain(y) < plain(high) ? y : high) : low) * trusted;
}

template <class Scalar>
Scalar TreeView::evaluate(std::span<const Scalar> u) const noexcept {
  ActiveLeaves<Scalar> leaves;
  active(u, leaves);
  return evaluate(u, leaves);
}

}  // namespace plumb

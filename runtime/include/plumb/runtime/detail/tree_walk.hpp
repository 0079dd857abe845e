// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "plumb/runtime/detail/plain.hpp"
#include "plumb/runtime/detail/tree_view.hpp"

/// The bodies of TreeView's templates.
namespace plumb {
namespace internal {

template <class Scalar>
struct OpenNode {
  int node;
  Scalar weight;
};

/// Closer than this share of a ramp to its end, one side's weight is lost in rounding and the side
/// is left out.
inline constexpr double kRampEnd = 0x1p-26;

/// Limits y softly: the identity in [low, high] and continuous in value and slope outside. A value
/// t outside the range is moved to m t / (m + t) < m outside it, where m is kSoftShare of the
/// range. NaN gives `low`.
template <class Scalar>
Scalar hold_softly(const Scalar& y, const Scalar& low, const Scalar& high) noexcept {
  const Scalar margin = (high - low) * kSoftShare;
  if (plain(y) > plain(high)) return high + margin * (y - high) / (margin + (y - high));
  if (plain(y) >= plain(low)) return y;
  if (plain(y) < plain(low)) return low - margin * (low - y) / (margin + (low - y));
  return low;
}

}  // namespace internal

template <bool kOblique, class Scalar>
Scalar TreeView::split_value(std::span<const Scalar> u, int node) const noexcept {
  if constexpr (!kOblique) return u[nodes_[node].input];
  const double* d = directions_ + static_cast<std::ptrdiff_t>(node) * inputs_;
  Scalar sum = u[0] * d[0];
  for (int i = 1; i < inputs_; ++i) sum = sum + u[i] * d[i];
  return sum;
}

/// One comparison. In a leaf the walk stands still: it reads the root again and ignores the result.
/// Masks are used because compilers turn a choice into a branch, which is unpredictable here.
template <bool kOblique, class Scalar>
int TreeView::step(std::span<const Scalar> u, int at) const noexcept {
  const int stays = at >> 31;
  const int read = at & ~stays;
  const format::TreeNode& node = nodes_[read];
  const int is_low = -static_cast<int>(plain(split_value<kOblique>(u, read)) <= node.threshold);
  const int next = node.high ^ ((node.high ^ node.low) & is_low);
  return (at & stays) | (next & ~stays);
}

template <bool kOblique, class Scalar>
int TreeView::hard_leaf(std::span<const Scalar> u) const noexcept {
  int at = leaves_ > 1 ? 0 : ~0;
  for (int i = 0; i < depth_; ++i) at = step<kOblique>(u, at);
  return ~at;
}

/// Walks depth first. Which sides contribute is decided before the division, which only nodes
/// inside a ramp need.
template <bool kOblique, class Scalar>
void TreeView::walk(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept {
  constexpr int kRoom = format::kMaxActiveLeaves;
  std::array<internal::OpenNode<Scalar>, kRoom> open;
  int waiting = 0, count = 0, at = leaves_ > 1 ? 0 : ~0;
  Scalar weight(1.0);
  for (;;) {
    while (at >= 0) {
      const format::TreeNode& node = nodes_[at];
      const double h = half_width_[at];
      const double width = 2.0 * h;
      const Scalar into = split_value<kOblique>(u, at) - (node.threshold - h);
      bool says_low = plain(into) < width * (1.0 - internal::kRampEnd);
      bool says_high = plain(into) > width * internal::kRampEnd;
      if (count + waiting + 1 >= kRoom) [[unlikely]] {
        says_high = plain(into) > 0.5 * width;
        says_low = !says_high;
      }
      if (says_low && says_high) {
        const Scalar s = into / width;
        const Scalar high = weight * (s * s * (3.0 - 2.0 * s));
        open[waiting++] = {node.high, high};
        weight = weight - high;
        at = node.low;
      } else {
        at = says_high ? node.high : node.low;
      }
    }
    out.leaf[count] = ~at;
    out.weight[count] = weight;
    ++count;
    if (waiting == 0) break;
    --waiting;
    at = open[waiting].node;
    weight = open[waiting].weight;
  }
  out.count = count;
}

template <class Scalar>
void TreeView::active(std::span<const Scalar> u, ActiveLeaves<Scalar>& out) const noexcept {
  out.count = 0;
  if (empty()) return;
  const bool oblique = directions_ != nullptr;
  if (blended()) return oblique ? walk<true>(u, out) : walk<false>(u, out);
  out.count = 1;
  out.leaf[0] = oblique ? hard_leaf<true>(u) : hard_leaf<false>(u);
  out.weight[0] = Scalar(1.0);
}

/// Product over the inputs of 3 s^2 - 2 s^3, where s falls from 1 at the border of the leaf's
/// region to 0 at kRegionFade outside it.
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

/// kInputs: number of inputs as a compile-time constant, so that short sums are unrolled; 0 means
/// inputs_.
template <int kInputs, class Scalar>
Scalar TreeView::leaf_value(std::span<const Scalar> u, int leaf) const noexcept {
  const int inputs = kInputs > 0 ? kInputs : inputs_;
  const double* w = coefficients_ + static_cast<std::ptrdiff_t>(leaf) * terms_;
  Scalar value(w[0]);
  for (int i = 0; i < inputs; ++i) value = value + u[i] * w[i + 1];
  if (degree_ < 2) return value;
  const double* next = w + inputs + 1;
  for (int i = 0; i < inputs; ++i)
    for (int k = i; k < inputs; ++k) value = value + (u[i] * u[k]) * *next++;
  return value;
}

template <int kInputs, class Scalar>
Scalar TreeView::sum(std::span<const Scalar> u, const ActiveLeaves<Scalar>& active) const noexcept {
  Scalar y(0.0), low(0.0), high(0.0), trusted(region_ == nullptr ? 1.0 : 0.0);
  for (int i = 0; i < active.count; ++i) {
    const int k = active.leaf[i];
    y = y + active.weight[i] * leaf_value<kInputs>(u, k);
    low = low + active.weight[i] * bounds_[2 * k];
    high = high + active.weight[i] * bounds_[2 * k + 1];
    if (region_ != nullptr) trusted = trusted + active.weight[i] * trust(u, k);
  }
  if (blended()) return internal::hold_softly(y, low, high) * trusted;
  // The order of these comparisons lets NaN give `low`.
  return (plain(y) > plain(low) ? (plain(y) < plain(high) ? y : high) : low) * trusted;
}

template <class Scalar>
Scalar TreeView::evaluate(std::span<const Scalar> u,
                          const ActiveLeaves<Scalar>& active) const noexcept {
  if (empty()) return Scalar(0.0);
  switch (inputs_) {
    case 2:
      return sum<2>(u, active);
    case 6:
      return sum<6>(u, active);
    default:
      return sum<0>(u, active);
  }
}

template <class Scalar>
Scalar TreeView::evaluate(std::span<const Scalar> u) const noexcept {
  ActiveLeaves<Scalar> leaves;
  active(u, leaves);
  return evaluate(u, leaves);
}

}  // namespace plumb

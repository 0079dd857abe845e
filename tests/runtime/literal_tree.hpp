// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::test {

/// format::Tree as its comment defines it, in long double and without a walk: every leaf's validity
/// is the product of the ramps on its path, however many leaves have one. Shares nothing with the
/// runtime. Cost: leaves x depth a point.
class LiteralTree {
 public:
  struct Step {
    int node;
    bool high;
  };

  /// Sums over the leaves. Without regions, trust is the sum of the validities.
  struct Said {
    long double y = 0.0L, low = 0.0L, high = 0.0L, trust = 0.0L, sigma = 0.0L;
    long double size = 0.0L;  // of the largest number that had to be added
    int active = 0;           // leaves with a validity

    long double margin() const { return 0.1L * (high - low); }
  };

  LiteralTree(const format::Tree& tree, int inputs)
      : tree_(tree), inputs_(static_cast<std::size_t>(inputs)) {
    for (std::size_t leaf = 0; leaf < tree.leaves(); ++leaf)
      paths_.push_back(path_to(~static_cast<int>(leaf)));
  }

  bool blended() const { return !tree_.blend_half_width.empty(); }

  long double split_value(int node, std::span<const double> u) const {
    const auto at = static_cast<std::size_t>(node);
    if (tree_.directions.empty()) return u[tree_.nodes[at].input];
    long double sum = 0.0L;
    for (std::size_t i = 0; i < inputs_; ++i)
      sum += static_cast<long double>(tree_.directions[at * inputs_ + i]) * u[i];
    return sum;
  }

  long double validity(std::size_t leaf, std::span<const double> u) const {
    long double out = 1.0L;
    for (const Step& step : paths_[leaf]) {
      const auto node = static_cast<std::size_t>(step.node);
      const long double x = split_value(step.node, u), c = tree_.nodes[node].threshold;
      long double high = x <= c ? 0.0L : 1.0L;
      if (blended()) {
        const long double h = tree_.blend_half_width[node];
        const long double s = std::clamp((x - c + h) / (2.0L * h), 0.0L, 1.0L);
        high = 3.0L * s * s - 2.0L * s * s * s;
      }
      out *= step.high ? high : 1.0L - high;
    }
    return out;
  }

  Said say(std::span<const double> u) const {
    Said out;
    for (std::size_t leaf = 0; leaf < paths_.size(); ++leaf) {
      const long double phi = validity(leaf, u);
      if (!(phi > 0.0L)) continue;
      ++out.active;
      out.low += phi * tree_.bounds[2 * leaf];
      out.high += phi * tree_.bounds[2 * leaf + 1];
      out.sigma += phi * tree_.sigma[leaf];
      out.trust += phi * trust(leaf, u);
      add_model(leaf, u, phi, out);
    }
    out.size = std::max({out.size, std::abs(out.low), std::abs(out.high)});
    return out;
  }

  long double value(const Said& said) const {
    long double y = std::clamp(said.y, said.low, said.high);
    const long double m = said.margin(), over = said.y - said.high, under = said.low - said.y;
    if (blended() && over > 0.0L) y = said.high + m * over / (m + over);
    if (blended() && under > 0.0L) y = said.low - m * under / (m + under);
    return y * said.trust;
  }

 private:
  std::vector<Step> path_to(int child) const {
    std::vector<Step> out;
    for (std::size_t node = tree_.nodes.size(); node-- > 0;) {  // parents stand before children
      const auto& n = tree_.nodes[node];
      if (n.low != child && n.high != child) continue;
      out.push_back({static_cast<int>(node), n.high == child});
      child = static_cast<int>(node);
    }
    return out;
  }

  void add_model(std::size_t leaf, std::span<const double> u, long double phi, Said& out) const {
    const std::size_t products = tree_.degree == 2 ? inputs_ * (inputs_ + 1) / 2 : 0;
    const double* w = &tree_.coefficients[leaf * (1 + inputs_ + products)];
    const auto add = [&](double coefficient, long double term) {
      out.y += phi * coefficient * term;
      out.size = std::max(out.size, std::abs(phi * coefficient * term));
    };
    add(*w++, 1.0L);
    for (std::size_t i = 0; i < inputs_; ++i) add(*w++, u[i]);
    for (std::size_t i = 0; tree_.degree == 2 && i < inputs_; ++i)
      for (std::size_t k = i; k < inputs_; ++k) add(*w++, static_cast<long double>(u[i]) * u[k]);
  }

  /// 1 inside the leaf's region, falling to 0 over 0.1 outside, for every input.
  long double trust(std::size_t leaf, std::span<const double> u) const {
    long double out = 1.0L;
    for (std::size_t i = 0; !tree_.region.empty() && i < inputs_; ++i) {
      const float* side = &tree_.region[(leaf * inputs_ + i) * 2];
      const long double outside = std::max<long double>(side[0] - static_cast<long double>(u[i]),
                                                        u[i] - static_cast<long double>(side[1]));
      const long double s = std::clamp(1.0L - outside / 0.1L, 0.0L, 1.0L);
      out *= 3.0L * s * s - 2.0L * s * s * s;
    }
    return out;
  }

  const format::Tree& tree_;
  std::size_t inputs_;
  std::vector<std::vector<Step>> paths_;
};

}  // namespace plumb::test

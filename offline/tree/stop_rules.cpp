// SPDX-License-Identifier: Apache-2.0
#include "tree/stop_rules.hpp"

#include <cmath>

#include "numbers/tails.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {
namespace {

struct Sums {
  double before = 0.0, after = 0.0;  // RSS [m^2]
  double n = 0.0;                    // samples
  double d = 0.0;                    // coefficients of a leaf
};

Sums sums_of(const GrownTree& tree, const TreeCell& cell) {
  return {.before = cell.model.rss,
          .after = tree.cells[cell.low].model.rss + tree.cells[cell.high].model.rss,
          .n = static_cast<double>(cell.model.samples),
          .d = static_cast<double>(format::leaf_terms(tree.inputs, tree.degree))};
}

/// Applies the rule from the root downwards. In the list of cells parents precede their children.
template <class Rule>
Splits from_the_root(const GrownTree& tree, const Rule& rule) {
  Splits out(tree.cells.size(), 0), reached(tree.cells.size(), 0);
  if (!reached.empty()) reached[0] = 1;
  for (std::size_t i = 0; i < tree.cells.size(); ++i) {
    const TreeCell& cell = tree.cells[i];
    if (!reached[i] || !cell.is_split() || !rule(sums_of(tree, cell))) continue;
    out[i] = reached[cell.low] = reached[cell.high] = 1;
  }
  return out;
}

}  // namespace

int leaves_at_gain(const GrownTree& tree, double share) {
  double rss = tree.cells.empty() ? 0.0 : tree.cells[0].model.rss;
  for (int k = 1; k < tree.leaves(); ++k) {
    const Sums sums = sums_of(tree, tree.cells[tree.split_order[k - 1]]);
    if (sums.before - sums.after < share * rss) return k;
    rss -= sums.before - sums.after;
  }
  return tree.leaves();
}

Splits stop_by_delta(const GrownTree& tree, double share) {
  if (tree.cells.empty()) return {};
  const LocalModel& root = tree.cells[0].model;
  const double d = static_cast<double>(format::leaf_terms(tree.inputs, tree.degree));
  const double least = share * share * root.rss / (root.samples - d);
  return from_the_root(tree, [&](const Sums& s) {
    return s.before / (s.n - s.d) - s.after / (s.n - 2.0 * s.d) >= least;
  });
}

Splits stop_by_chow(const GrownTree& tree, double alpha) {
  return from_the_root(tree, [&](const Sums& s) {
    const double freedom = s.n - 2.0 * s.d, tried = s.n * tree.inputs;
    if (!(freedom > 0.0)) return false;
    const double f = (s.before - s.after) * freedom / (s.d * s.after);
    return ln_f_tail(f, s.d, freedom) + std::log(tried) < std::log(alpha);
  });
}

}  // namespace plumb::offline

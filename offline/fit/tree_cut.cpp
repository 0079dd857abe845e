// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "fit/tree_growth.hpp"

namespace plumb::offline {
namespace {

/// With k leaves, has this cell been split already?
bool is_split(const TreeCell& cell, int k) { return cell.input >= 0 && cell.split_at < k; }

/// With k leaves, cells that are leaves: those made by the first k - 1 splits and not split yet.
std::vector<int> leaves_of(const GrownTree& tree, int k) {
  std::vector<int> out;
  for (int cell = 0; cell < 2 * k - 1; ++cell)
    if (!is_split(tree.cells[cell], k)) out.push_back(cell);
  return out;
}

void append_leaf(const LocalModel& model, int inputs, format::Tree& out) {
  out.coefficients.insert(out.coefficients.end(), model.w.begin(), model.w.begin() + inputs + 1);
  out.bounds.push_back(model.y_min);
  out.bounds.push_back(model.y_max);
}

}  // namespace

double LocalModel::predict(std::span<const double> u) const {
  double sum = w[0];
  for (std::size_t i = 0; i < u.size(); ++i) sum += w[i + 1] * u[i];
  return std::clamp(sum, y_min, y_max);
}

double GrownTree::rss(int k) const {
  double sum = 0.0;
  for (int cell : leaves_of(*this, k)) sum += cells[cell].model.rss;
  return sum;
}

format::Tree GrownTree::cut(int k) const {
  format::Tree out;
  if (k == 0) return out;
  std::vector<int> child(2 * k - 1);  // of a cell, as the model file counts
  for (int node = 0; node < k - 1; ++node) child[split_order[node]] = node;
  int leaf = 0;
  for (int cell : leaves_of(*this, k)) {
    child[cell] = ~leaf++;
    append_leaf(cells[cell].model, inputs, out);
    out.depth = std::max(out.depth, static_cast<std::uint16_t>(cells[cell].depth));
  }
  for (int node = 0; node < k - 1; ++node) {
    const TreeCell& cell = cells[split_order[node]];
    out.nodes.push_back({.threshold = cell.threshold,
                         .input = static_cast<std::uint16_t>(cell.input),
                         .low = static_cast<std::int16_t>(child[cell.low]),
                         .high = static_cast<std::int16_t>(child[cell.high])});
  }
  return out;
}

int GrownTree::leaves_at_gain(double share) const {
  for (int k = 1; k < leaves(); ++k) {
    const double now = rss(k);
    if (now - rss(k + 1) < share * now) return k;
  }
  return leaves();
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "tree/grown_tree.hpp"

#include <algorithm>

#include "plumb/runtime/detail/tree.hpp"

namespace plumb::offline {
namespace {

bool stands(const GrownTree& tree, const Splits& stand, int cell) {
  return tree.cells[cell].is_split() && stand[cell];
}

/// The cells that the standing splits lead to, level by level, so that parents precede their
/// children.
std::vector<int> reached(const GrownTree& tree, const Splits& stand) {
  std::vector<int> out;
  if (!tree.cells.empty()) out.push_back(0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!stands(tree, stand, out[i])) continue;
    const TreeCell& cell = tree.cells[out[i]];
    out.push_back(cell.low);
    out.push_back(cell.high);
  }
  return out;
}

void append_leaf(const LocalModel& model, std::size_t terms, int output, format::Tree& out) {
  const auto first = model.w.begin() + static_cast<std::ptrdiff_t>(terms) * output;
  out.coefficients.insert(out.coefficients.end(), first,
                          first + static_cast<std::ptrdiff_t>(terms));
  out.bounds.push_back(model.y_min[output]);
  out.bounds.push_back(model.y_max[output]);
}

void append_node(const TreeCell& cell, int low, int high, format::Tree& out) {
  out.nodes.push_back({.threshold = cell.threshold,
                       .input = static_cast<std::uint16_t>(cell.input),
                       .low = static_cast<std::int16_t>(low),
                       .high = static_cast<std::int16_t>(high)});
}

}  // namespace

double GrownTree::predict(int cell, std::span<const double> u, int output) const {
  std::array<double, format::kMaxLeafTerms> terms;
  fill_leaf_terms<double>(u, degree, terms);
  const LocalModel& model = cells[cell].model;
  const std::size_t count = format::leaf_terms(u.size(), degree);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += model.w[output * count + i] * terms[i];
  return std::clamp(sum, model.y_min[output], model.y_max[output]);
}

Splits GrownTree::first_splits(int k) const {
  Splits out(cells.size(), 0);
  for (int i = 0; i + 1 < k; ++i) out[split_order[i]] = 1;
  return out;
}

std::vector<int> GrownTree::leaf_cells(const Splits& stand) const {
  std::vector<int> out;
  for (int cell : reached(*this, stand))
    if (!stands(*this, stand, cell)) out.push_back(cell);
  return out;
}

double GrownTree::rss(int k) const {
  double sum = 0.0;
  for (int cell : leaf_cells(first_splits(k))) sum += cells[cell].model.rss;
  return sum;
}

format::Tree GrownTree::cut(const Splits& stand, int output) const {
  format::Tree out;
  out.degree = static_cast<std::uint8_t>(degree);
  std::vector<int> child(cells.size()), inner;  // child: number of a cell in the model file
  int leaf = 0;
  for (int cell : reached(*this, stand)) {
    if (stands(*this, stand, cell)) {
      child[cell] = static_cast<int>(inner.size());
      inner.push_back(cell);
      continue;
    }
    child[cell] = ~leaf++;
    append_leaf(cells[cell].model, format::leaf_terms(inputs, degree), output, out);
    out.depth = std::max(out.depth, static_cast<std::uint16_t>(cells[cell].depth));
  }
  for (int cell : inner)
    append_node(cells[cell], child[cells[cell].low], child[cells[cell].high], out);
  return out;
}

format::Tree GrownTree::cut(int k, int output) const {
  return k == 0 ? format::Tree{} : cut(first_splits(k), output);
}

}  // namespace plumb::offline

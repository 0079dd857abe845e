// SPDX-License-Identifier: Apache-2.0
#include "tree/rows.hpp"

#include <algorithm>
#include <numeric>

#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "tree/scan.hpp"

namespace plumb::offline {
namespace {

/// The number of outputs in a row. The search is compiled for one or three outputs, so two are
/// stored as three, the third being 0.
int laid_out(Eigen::Index outputs) { return outputs == 1 ? 1 : format::kTreeAxes; }

TrainingRows lay_out(const Samples& u, const Samples& y, const std::vector<int>& order,
                     std::vector<int> terms, int degree) {
  TrainingRows out;
  out.rows = static_cast<int>(order.size());
  out.outputs = laid_out(y.cols());
  out.stride = static_cast<int>(terms.size()) + out.outputs;
  out.values.reserve(order.size() * out.stride);
  std::array<double, format::kMaxLeafTerms> all;
  for (int row : order) {
    fill_leaf_terms<double>(SampleRow(u, row).span(), degree, all);
    for (int term : terms) out.values.push_back(all[term]);
    for (int k = 0; k < out.outputs; ++k) out.values.push_back(k < y.cols() ? y(row, k) : 0.0);
  }
  for (int term : terms) out.inputs += term <= u.cols();
  out.terms = std::move(terms);
  return out;
}

}  // namespace

std::vector<int> lexicographic(const Samples& table) {
  std::vector<int> order(table.rows());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    for (Eigen::Index k = 0; k < table.cols(); ++k)
      if (table(a, k) != table(b, k)) return table(a, k) < table(b, k);
    return false;
  });
  return order;
}

TrainingRows training_rows(const Samples& u, const Samples& y, int degree) {
  Samples table(u.rows(), u.cols() + y.cols());
  table << u, y;
  const auto order = lexicographic(table);
  std::vector<int> terms(format::leaf_terms(static_cast<std::size_t>(u.cols()), degree) - 1);
  std::iota(terms.begin(), terms.end(), 1);
  TrainingRows out = lay_out(u, y, order, terms, degree);
  while (!terms.empty()) {
    const int dependent = dependent_term(out);
    if (dependent < 0) break;
    terms.erase(terms.begin() + dependent);
    out = lay_out(u, y, order, terms, degree);
  }
  return out;
}

}  // namespace plumb::offline

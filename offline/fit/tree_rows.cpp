// SPDX-License-Identifier: Apache-2.0
#include "fit/tree_rows.hpp"

#include <algorithm>
#include <numeric>

#include "fit/tree_scan.hpp"

namespace plumb::offline {
namespace {

TrainingRows lay_out(const Samples& u, const Eigen::VectorXd& y, const std::vector<int>& order,
                     std::vector<int> inputs) {
  TrainingRows out;
  out.rows = static_cast<int>(order.size());
  out.stride = static_cast<int>(inputs.size()) + 1;
  out.values.reserve(order.size() * out.stride);
  for (int row : order) {
    for (int input : inputs) out.values.push_back(u(row, input));
    out.values.push_back(y[row]);
  }
  out.inputs = std::move(inputs);
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

TrainingRows training_rows(const Samples& u, const Eigen::VectorXd& y) {
  Samples table(u.rows(), u.cols() + 1);
  table << u, y;
  const auto order = lexicographic(table);
  std::vector<int> inputs(u.cols());
  std::iota(inputs.begin(), inputs.end(), 0);
  TrainingRows out = lay_out(u, y, order, inputs);
  while (!inputs.empty()) {
    const int dependent = dependent_input(out);
    if (dependent < 0) break;
    inputs.erase(inputs.begin() + dependent);
    out = lay_out(u, y, order, inputs);
  }
  return out;
}

}  // namespace plumb::offline

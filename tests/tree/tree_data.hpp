// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "cell/random.hpp"
#include "tree/growth.hpp"

/// Data and an evaluation of model-file trees for the tests, sharing nothing with the trainer.
namespace plumb::offline::tree_data {

inline double gauss(Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.unit())) *
         std::cos(2.0 * std::numbers::pi * random.unit());
}

inline Samples uniform(int rows, int columns, double low, double high, Random& random) {
  Samples out(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < columns; ++k) out(i, k) = low + (high - low) * random.unit();
  return out;
}

/// Full grid of `per_axis` values a column, shape (per_axis^columns, columns).
inline Samples grid(int per_axis, int columns) {
  int rows = 1;
  for (int k = 0; k < columns; ++k) rows *= per_axis;
  Samples out(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int k = 0, rest = i; k < columns; ++k, rest /= per_axis)
      out(i, k) = -1.0 + 2.0 * (rest % per_axis) / (per_axis - 1);
  return out;
}

/// Smooth, nonlinear, in every input; of size `size`.
inline Eigen::VectorXd smooth(const Samples& u, double size) {
  Eigen::VectorXd y(u.rows());
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    double sum = 0.3;
    for (Eigen::Index k = 0; k < u.cols(); ++k)
      sum += std::sin((2.0 + 0.4 * static_cast<double>(k)) * u(i, k) + 0.5) *
             std::cos(u(i, (k + 1) % u.cols()));
    y[i] = size * sum;
  }
  return y;
}

inline std::vector<int> numbered(int n) {
  std::vector<int> out(n);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

inline Samples permuted(const Samples& all, const std::vector<int>& order) {
  Samples out(all.rows(), all.cols());
  for (std::size_t i = 0; i < order.size(); ++i) out.row(i) = all.row(order[i]);
  return out;
}

inline std::vector<int> shuffled(int n, Random& random) {
  auto out = numbered(n);
  for (int k = n - 1; k > 0; --k) std::swap(out[k], out[random.below(k + 1)]);
  return out;
}

/// Leaf of a model-file tree that row i falls into, and the compares on the way.
struct Landing {
  int leaf = 0;
  int compares = 0;
};
inline Landing land(const format::Tree& tree, const Samples& u, Eigen::Index i) {
  Landing out;
  if (tree.nodes.empty()) return out;
  int at = 0;
  while (at >= 0) {
    const auto& node = tree.nodes[at];
    at = u(i, node.input) <= node.threshold ? node.low : node.high;
    ++out.compares;
  }
  out.leaf = ~at;
  return out;
}

/// The model file's definition, read literally.
inline double evaluate(const format::Tree& tree, const Samples& u, Eigen::Index i) {
  if (tree.bounds.empty()) return 0.0;
  const int leaf = land(tree, u, i).leaf;
  const auto inputs = u.cols();
  const double* w = &tree.coefficients[leaf * (inputs + 1)];
  double sum = w[0];
  for (Eigen::Index k = 0; k < inputs; ++k) sum += w[k + 1] * u(i, k);
  return std::min(std::max(sum, tree.bounds[2 * leaf]), tree.bounds[2 * leaf + 1]);
}

}  // namespace plumb::offline::tree_data

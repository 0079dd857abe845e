// SPDX-License-Identifier: Apache-2.0
#include "study/textbook_trees.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/pivoted_qr.hpp"

namespace plumb::offline::study {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSigmaShare = 1.0 / 3.0;  // share of the width of a cell
constexpr double kM5 = 15.0;  // weight of the parent in the smoothing of M5 [Quinlan 1992]

struct Cell {
  VectorXd low, high;
  VectorXd w;  // constant, then slopes

  VectorXd membership(const Samples& u) const {
    const VectorXd middle = 0.5 * (low + high), sigma = kSigmaShare * (high - low);
    VectorXd out(u.rows());
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      out[i] =
          std::exp(-0.5 * ((u.row(i).transpose() - middle).array() / sigma.array()).square().sum());
    return out;
  }
};

MatrixXd with_constant(const Samples& u) {
  MatrixXd out(u.rows(), u.cols() + 1);
  out << VectorXd::Ones(u.rows()), u;
  return out;
}

/// The weights of the cells (columns) at the samples (rows). Each row adds up to 1.
MatrixXd validity(const std::vector<Cell>& cells, const Samples& u) {
  MatrixXd out(u.rows(), static_cast<Eigen::Index>(cells.size()));
  for (std::size_t k = 0; k < cells.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) = cells[k].membership(u);
  const VectorXd sum = out.rowwise().sum();
  return out.array().colwise() / sum.array().max(1e-300);
}

void fit_locally(std::vector<Cell>& cells, const Samples& u, const VectorXd& y,
                 const std::vector<std::size_t>& which) {
  const MatrixXd weight = validity(cells, u), X = with_constant(u);
  for (std::size_t k : which) {
    const VectorXd root = weight.col(static_cast<Eigen::Index>(k)).cwiseSqrt();
    cells[k].w = PivotedQr(root.asDiagonal() * X).solve(root.cwiseProduct(y));
  }
}

VectorXd predict(const std::vector<Cell>& cells, const Samples& u) {
  const MatrixXd weight = validity(cells, u), X = with_constant(u);
  VectorXd out = VectorXd::Zero(u.rows());
  for (std::size_t k = 0; k < cells.size(); ++k)
    out += weight.col(static_cast<Eigen::Index>(k)).cwiseProduct(X * cells[k].w);
  return out;
}

std::size_t worst_cell(const std::vector<Cell>& cells, const Samples& u, const VectorXd& y) {
  const VectorXd squared = (y - predict(cells, u)).cwiseAbs2();
  Eigen::Index worst = 0;
  (validity(cells, u).transpose() * squared).maxCoeff(&worst);
  return static_cast<std::size_t>(worst);
}

std::vector<Cell> halved(const std::vector<Cell>& cells, std::size_t which, Eigen::Index input,
                         const Samples& u, const VectorXd& y) {
  std::vector<Cell> out = cells;
  const double middle = 0.5 * (out[which].low[input] + out[which].high[input]);
  out.push_back(out[which]);
  out[which].high[input] = middle;
  out.back().low[input] = middle;
  fit_locally(out, u, y, {which, out.size() - 1});
  return out;
}

}  // namespace

format::Tree unheld(format::Tree tree) {
  for (std::size_t i = 0; i < tree.bounds.size(); ++i) tree.bounds[i] = i % 2 == 0 ? -1e300 : 1e300;
  return tree;
}

VectorXd lolimot(const Samples& u, const VectorXd& y, int leaves, const Samples& u_test) {
  std::vector<Cell> cells{{-VectorXd::Ones(u.cols()), VectorXd::Ones(u.cols()), {}}};
  fit_locally(cells, u, y, {0});
  while (static_cast<int>(cells.size()) < leaves) {
    const std::size_t worst = worst_cell(cells, u, y);
    std::vector<Cell> best;
    double least = INFINITY;
    for (Eigen::Index input = 0; input < u.cols(); ++input) {
      auto tried = halved(cells, worst, input, u, y);
      const double rss = (y - predict(tried, u)).squaredNorm();
      if (!(rss < least)) continue;
      least = rss;
      best = std::move(tried);
    }
    cells = std::move(best);
  }
  return predict(cells, u_test);
}

VectorXd m5_smoothed(const GrownTree& tree, const Splits& stand, const Samples& u_test) {
  VectorXd out(u_test.rows());
  for (Eigen::Index i = 0; i < u_test.rows(); ++i) {
    const SampleRow row(u_test, i);
    std::vector<int> path{0};
    while (tree.cells[path.back()].is_split() && stand[path.back()]) {
      const TreeCell& cell = tree.cells[path.back()];
      path.push_back(cell.split_value(row.span()) <= cell.threshold ? cell.low : cell.high);
    }
    double value = tree.predict(path.back(), row.span(), 0);
    for (std::size_t k = path.size() - 1; k > 0; --k) {
      const double n = tree.cells[path[k]].model.samples;
      value = (n * value + kM5 * tree.predict(path[k - 1], row.span(), 0)) / (n + kM5);
    }
    out[i] = value;
  }
  return out;
}

}  // namespace plumb::offline::study

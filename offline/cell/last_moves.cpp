// SPDX-License-Identifier: Apache-2.0
#include "cell/last_moves.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace plumb::offline {
namespace {

using RowsN = RowsN;

/// Encoders of a joint at rest differ by less [rad] or [m].
constexpr double kNoMove = 1e-5;

/// The columns of one file; empty unless it has them for every joint.
struct Arrivals {
  std::vector<const Column*> direction, travel;
};

Arrivals arrivals_of(const Table& table, Eigen::Index joints) {
  Arrivals out;
  for (Eigen::Index j = 1; j <= joints; ++j) {
    const Column* direction = table.find("dir_j" + std::to_string(j));
    const Column* travel = table.find("travel_j" + std::to_string(j));
    const auto has = [](const Column* column) {
      return column != nullptr && !column->values.empty();
    };
    if (!has(direction) || !has(travel)) return {};
    out.direction.push_back(direction);
    out.travel.push_back(travel);
  }
  return out;
}

double share(double direction, double travel, double largest) {
  if (travel <= kNoMove || largest <= kNoMove) return 0.0;
  return direction == 0.0 ? kUnknown : direction * travel / largest;
}

/// Known values from the columns overwrite those from the neighbouring rows.
void from_columns(const Arrivals& arrivals, int rows, Eigen::Index first, RowsN& out) {
  for (int i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    double largest = 0.0;
    for (const Column* travel : arrivals.travel) largest = std::max(largest, travel->values[at]);
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const auto joint = static_cast<std::size_t>(j);
      const double moved =
          share(arrivals.direction[joint]->values[at], arrivals.travel[joint]->values[at], largest);
      if (!std::isnan(moved)) out(first + i, j) = moved;
    }
  }
}

void from_neighbours(const RowsN& q, int rows, Eigen::Index first, RowsN& out) {
  if (rows > 0) out.row(first).setZero();
  for (Eigen::Index i = first + 1; i < first + rows; ++i) {
    const double largest = (q.row(i) - q.row(i - 1)).cwiseAbs().maxCoeff();
    // If the arm did not move, the last move is still that of the row before.
    out.row(i) = largest > kNoMove ? ((q.row(i) - q.row(i - 1)) / largest).eval() : out.row(i - 1);
  }
}

}  // namespace

RowsN last_moves(std::span<const Table> tables, const RowsN& q, Neighbours neighbours) {
  RowsN out = RowsN::Constant(q.rows(), q.cols(), kUnknown);
  Eigen::Index first = 0;
  for (const auto& table : tables) {
    const Arrivals arrivals = arrivals_of(table, q.cols());
    if (neighbours == Neighbours::kTheRowBefore) from_neighbours(q, table.rows(), first, out);
    if (!arrivals.direction.empty()) from_columns(arrivals, table.rows(), first, out);
    first += table.rows();
  }
  return out;
}

void forget_order(std::span<const Table> tables, const RowsN& q, ContextRows& rows) {
  rows.step = last_moves(tables, q, Neighbours::kNone);
  rows.order = Eigen::VectorXd::Constant(q.rows(), kUnknown);
}

}  // namespace plumb::offline

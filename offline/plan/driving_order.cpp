// SPDX-License-Identifier: Apache-2.0
#include "plan/driving_order.hpp"

#include <algorithm>
#include <numeric>

namespace plumb::offline {
namespace {

constexpr int kMostSwaps = 30;

/// Poses with the start as number n.
class Roads {
 public:
  Roads(const RowsN& q, const Eigen::VectorXd& range, const Eigen::VectorXd& start)
      : places_(q.rows() + 1, q.cols()) {
    places_.topRows(q.rows()) = q;
    places_.row(q.rows()) = start.transpose();
    places_.array().rowwise() /= range.transpose().array();
  }
  double between(int a, int b) const {
    return (places_.row(a) - places_.row(b)).cwiseAbs().maxCoeff();
  }
  int start() const { return static_cast<int>(places_.rows()) - 1; }

 private:
  RowsN places_;
};

std::vector<int> nearest_first(const Roads& roads, int n) {
  std::vector<int> left(static_cast<std::size_t>(n)), out;
  std::iota(left.begin(), left.end(), 0);
  int at = roads.start();
  while (!left.empty()) {
    const auto next = std::min_element(left.begin(), left.end(), [&](int a, int b) {
      return roads.between(at, a) < roads.between(at, b);
    });
    at = *next;
    out.push_back(at);
    left.erase(next);
  }
  return out;
}

bool uncross(const Roads& roads, std::vector<int>& order) {
  bool shorter = false;
  const auto n = order.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      const int before = i == 0 ? roads.start() : order[i - 1];
      double change = roads.between(before, order[k]) - roads.between(before, order[i]);
      if (k + 1 < n)
        change += roads.between(order[i], order[k + 1]) - roads.between(order[k], order[k + 1]);
      if (change > -1e-12) continue;
      std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
                   order.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      shorter = true;
    }
  return shorter;
}

}  // namespace

std::vector<int> driving_order(const RowsN& q, const Eigen::VectorXd& range,
                               const Eigen::VectorXd& start) {
  const Roads roads(q, range, start);
  std::vector<int> out = nearest_first(roads, static_cast<int>(q.rows()));
  for (int round = 0; round < kMostSwaps && uncross(roads, out); ++round) {
  }
  return out;
}

double driving_length(const RowsN& q, const std::vector<int>& order, const Eigen::VectorXd& range,
                      const Eigen::VectorXd& start) {
  const Roads roads(q, range, start);
  double out = 0.0;
  int at = roads.start();
  for (const int i : order) out += roads.between(at, i), at = i;
  return out;
}

}  // namespace plumb::offline

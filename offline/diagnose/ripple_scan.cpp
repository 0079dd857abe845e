// SPDX-License-Identifier: Apache-2.0
#include "diagnose/ripple_scan.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr std::size_t kMostWaves = 12;
constexpr double kPays = 3.0;      // nats, after what the search costs
constexpr double kFinest = 0.004;  // cycles a turn

/// Gram matrix and products of all waves, cleared of the model and of what was picked.
struct Field {
  Eigen::MatrixXd gram;
  Eigen::VectorXd v;
  double Q = 0.0;

  /// Evidence of wave k alone, by what is left.
  Evidence of(std::size_t k, const EvidenceScale& scale) const {
    const auto at = static_cast<Eigen::Index>(2 * k);
    return evidence(gram.block(at, at, 2, 2), v.segment(at, 2), Q, scale);
  }

  /// Takes wave k out of everything.
  void pick(std::size_t k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    Eigen::Matrix2d own = gram.block(at, at, 2, 2);
    own.diagonal().array() += 1e-9 * own.trace();
    const Eigen::Matrix2d inverse = own.inverse();
    const Eigen::MatrixXd across = gram.middleCols(at, 2);
    const Eigen::Vector2d theta = inverse * v.segment(at, 2);
    Q -= v.segment(at, 2).dot(theta);
    v -= across * theta;
    gram -= across * (inverse * across.transpose());
  }
};

double ln_bayes_of(const Judge& judge, int joint, const std::vector<double>& cycles) {
  return judge.judge(ripple_block(judge.stage(), joint, cycles)).evidence.ln_bayes;
}

/// Each frequency in turn climbs between its neighbours on the grid.
void refine(const Judge& judge, Ripples& out, double step) {
  double best = ln_bayes_of(judge, out.joint, out.cycles);
  for (double& k : out.cycles)
    for (double h = 0.5 * step; h > kFinest;) {
      const double middle = k;
      bool better = false;
      for (const double sign : {-1.0, 1.0}) {
        k = middle + sign * h;
        const double ln = ln_bayes_of(judge, out.joint, out.cycles);
        if (ln > best) {
          best = ln;
          better = true;
          break;
        }
        k = middle;
      }
      if (!better) h *= 0.5;
    }
  for (double& k : out.cycles) k = std::round(100.0 * k) / 100.0;
}

}  // namespace

Ripples scan_ripples(const Judge& judge, int joint, double blocks, int& tried) {
  Ripples out{.joint = joint, .cycles = {}, .strongest_ln_bayes = -1e6};
  const auto grid = ripple_grid(judge.stage(), joint);
  if (grid.empty()) return out;
  tried += static_cast<int>(grid.size());
  const Products all = judge.products(ripple_block(judge.stage(), joint, grid));
  Field field{all.XX - all.UX.transpose() * all.UX, all.Xy, judge.stage().Q};
  const double price = std::log(std::max(1.0, blocks + static_cast<double>(grid.size()))) + kPays;
  while (out.cycles.size() < kMostWaves) {
    std::size_t best = 0;
    double most = -1e6;
    for (std::size_t k = 0; k < grid.size(); ++k) {
      const double ln = field.of(k, judge.scale()).ln_bayes;
      if (ln > most) most = ln, best = k;
    }
    if (out.cycles.empty()) out.strongest_ln_bayes = most;
    if (!out.cycles.empty() && most < price) break;
    out.cycles.push_back(grid[best]);
    if (most < price) break;
    field.pick(best);
  }
  if (out.strongest_ln_bayes >= price)
    refine(judge, out, grid.size() > 1 ? grid[1] - grid[0] : 0.5);
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "figures/joint_residual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "noise/step_motions.hpp"

namespace plumb::offline::figures {
namespace {

constexpr int kCurvePoints = 160;
constexpr std::array<double, 4> kBandwidths{1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0};
constexpr double kReach = 3.5;       // bandwidths beyond which a pose has no weight
constexpr double kLeastPoses = 4.0;  // effective number for a mean to be drawn
constexpr double kTwoSided95 = 1.96;
constexpr double kLeastMotion = 1e-6;  // [m/rad] or [m/m]

/// The local mean at one place.
struct Local {
  double sum = 0.0, squares = 0.0, mean = 0.0;  // of the weights
  JointResidual::Mean out;
};

Local local_mean(const std::vector<JointResidual::Pose>& poses, double q, double bandwidth) {
  Local at;
  at.out = {q, NAN, NAN};
  const auto begin =
      std::lower_bound(poses.begin(), poses.end(), q - kReach * bandwidth,
                       [](const JointResidual::Pose& pose, double v) { return pose.q < v; });
  double products = 0.0, w2v = 0.0, w2v2 = 0.0;
  for (auto pose = begin; pose != poses.end() && pose->q <= q + kReach * bandwidth; ++pose) {
    const double z = (pose->q - q) / bandwidth, w = pose->weight * std::exp(-0.5 * z * z);
    at.sum += w, at.squares += w * w, products += w * pose->value;
    w2v += w * w * pose->value, w2v2 += w * w * pose->value * pose->value;
  }
  if (!(at.sum > 0.0)) return at;
  at.mean = products / at.sum;
  if (at.sum * at.sum < kLeastPoses * at.squares) return at;
  const double spread = w2v2 - 2.0 * at.mean * w2v + at.mean * at.mean * at.squares;
  const double n = at.sum * at.sum / at.squares;
  at.out.value = at.mean;
  at.out.half = kTwoSided95 * std::sqrt(std::max(0.0, spread) * n / (n - 1.0)) / at.sum;
  return at;
}

/// Weighted square of what the mean misses at each pose when it is left out of it.
double missed_squares(const std::vector<JointResidual::Pose>& poses, const std::vector<Local>& grid,
                      double bandwidth) {
  const double step = (grid.back().out.q - grid.front().out.q) / (kCurvePoints - 1);
  double out = 0.0;
  for (const auto& pose : poses) {
    const auto k = static_cast<std::size_t>(
        std::clamp(std::round((pose.q - grid.front().out.q) / step), 0.0, kCurvePoints - 1.0));
    const Local& at = grid[k];
    const double z = (pose.q - at.out.q) / bandwidth;
    const double own = pose.weight * std::exp(-0.5 * z * z);
    const double rest = at.sum - own;
    const double mean = rest > 1e-3 * own ? (at.mean * at.sum - own * pose.value) / rest : 0.0;
    out += pose.weight * (pose.value - mean) * (pose.value - mean);
  }
  return out;
}

double curve_at(const std::vector<JointResidual::Mean>& curve, double q) {
  if (curve.empty()) return 0.0;
  const double step = (curve.back().q - curve.front().q) / (kCurvePoints - 1);
  const auto k = static_cast<std::size_t>(std::clamp(std::round((q - curve.front().q) / step), 0.0,
                                                     static_cast<double>(curve.size() - 1)));
  return std::isfinite(curve[k].value) ? curve[k].value : 0.0;
}

void add_curve(JointResidual& out) {
  if (out.poses.empty()) return;
  const double low = out.poses.front().q, high = out.poses.back().q;
  if (!(high > low)) return;
  double least = INFINITY;
  for (const double share : kBandwidths) {
    std::vector<Local> grid;
    for (int k = 0; k < kCurvePoints; ++k)
      grid.push_back(
          local_mean(out.poses, low + (high - low) * k / (kCurvePoints - 1), share * (high - low)));
    const double missed = missed_squares(out.poses, grid, share * (high - low));
    if (missed >= least) continue;
    least = missed;
    out.curve.clear();
    for (const Local& at : grid) out.curve.push_back(at.out);
  }
}

void add_rms(JointResidual& out) {
  double weights = 0.0, all = 0.0, rest = 0.0;
  for (const auto& pose : out.poses) {
    const double left = pose.value - curve_at(out.curve, pose.q);
    weights += pose.weight, all += pose.weight * pose.value * pose.value;
    rest += pose.weight * left * left;
  }
  if (!(weights > 0.0)) return;
  out.rms = std::sqrt(all / weights);
  out.rms_without_curve = std::sqrt(rest / weights);
}

}  // namespace

std::vector<JointResidual> joint_residuals(const RunResults& results) {
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  std::sort(rows.begin(), rows.end());
  std::vector<JointResidual> out;
  if (rows.empty()) return out;
  const Fit& fit = results.run.fit;
  rows = without_outliers(without_outliers(rows, fit.calibration.outliers), fit.held_outliers);
  const StepMotions motions(fit.calibration.state, results.measured,
                            series(results.measured, results.after_M, rows));
  const std::set<int> held(results.held.begin(), results.held.end());
  for (int j = 0; j < motions.joints(); ++j) {
    JointResidual one{.joint = j,
                      .name = results.cell.nominal.joints[static_cast<std::size_t>(j)].name,
                      .turns = motions.turns(j)};
    for (int k = 0; k < motions.size(); ++k) {
      const int row = motions.rows()[static_cast<std::size_t>(k)];
      const Eigen::Vector3d m = motions.joint(k, j);
      if (m.norm() < kLeastMotion) continue;
      JointResidual::Pose pose{row, results.measured.q(row, j),
                               m.dot(motions.error(k)) / m.squaredNorm(), m.squaredNorm()};
      const auto& direction = results.measured.context.direction;
      if (direction.rows() > row && std::isfinite(direction(row, j)))
        pose.side = direction(row, j) > 0.0 ? 1 : direction(row, j) < 0.0 ? -1 : 0;
      pose.held = held.contains(row);
      one.poses.push_back(pose);
    }
    std::stable_sort(one.poses.begin(), one.poses.end(),
                     [](const auto& a, const auto& b) { return a.q < b.q; });
    if (one.poses.empty() || !(one.poses.back().q > one.poses.front().q)) continue;
    add_curve(one);
    add_rms(one);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace plumb::offline::figures

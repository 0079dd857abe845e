// SPDX-License-Identifier: Apache-2.0
#include "figures/joint_residual.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "fit/step_motions.hpp"

namespace plumb::offline::figures {
namespace {

constexpr int kCurvePoints = 100;
constexpr double kBandwidth = 1.0 / 16.0;  // of the range of the joint
constexpr double kReach = 4.0;             // bandwidths beyond which a pose has no weight
constexpr double kLeastPoses = 4.0;        // effective number for a mean to be drawn
constexpr double kTwoSided95 = 1.96;
constexpr double kLeastMotion = 1e-6;  // [m/rad] or [m/m]

JointResidual::Mean local_mean(const std::vector<JointResidual::Pose>& poses, double q,
                               double bandwidth) {
  double sum = 0.0, squares = 0.0, mean = 0.0;
  const auto weight = [&](const JointResidual::Pose& pose) {
    const double z = (pose.q - q) / bandwidth;
    return std::abs(z) > kReach ? 0.0 : pose.weight * std::exp(-0.5 * z * z);
  };
  for (const auto& pose : poses) {
    const double w = weight(pose);
    sum += w, squares += w * w, mean += w * pose.value;
  }
  if (!(sum > 0.0) || sum * sum < kLeastPoses * squares) return {q, NAN, NAN};
  mean /= sum;
  double spread = 0.0;
  for (const auto& pose : poses) {
    const double w = weight(pose);
    spread += w * w * (pose.value - mean) * (pose.value - mean);
  }
  const double n = sum * sum / squares;
  return {q, mean, kTwoSided95 * std::sqrt(spread * n / (n - 1.0)) / sum};
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
  for (int k = 0; k < kCurvePoints; ++k)
    out.curve.push_back(local_mean(out.poses, low + (high - low) * k / (kCurvePoints - 1),
                                   kBandwidth * (high - low)));
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

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/whitened_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "cell/replicates.hpp"
#include "diagnose/constants.hpp"
#include "fit/split.hpp"
#include "noise/noise_floor.hpp"
#include "noise/orientation_floor.hpp"
#include "noise/weights.hpp"
#include "plumb/runtime/detail/effect_set.hpp"
#include "solve/evaluation.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline {
namespace {

/// Rows by fold; repeats of a pose share one.
void deal(const Measurements& measured, const std::vector<int>& fit, const std::vector<int>& held,
          WhitenedFit& out) {
  const Measurements some = pick(measured, fit);
  HeldOutRule rule;
  rule.kind = HeldOutRule::Kind::kFolds;
  const int groups = [&] {
    std::vector<int> all = pose_groups(some);
    std::sort(all.begin(), all.end());
    return static_cast<int>(std::unique(all.begin(), all.end()) - all.begin());
  }();
  rule.folds = std::min(groups, groups < kManyPoses ? kManyFoldCount : kFoldCount);
  // A point whose every row were held out would be known to no row of the fit.
  const Split split = split_poses(some, rule, out.cell->measurement.seed, NeverSplit::kPoses);
  for (int f = 0; f < rule.folds; ++f) {
    const auto begin = static_cast<Eigen::Index>(out.row.size());
    for (std::size_t i = 0; i < fit.size(); ++i)
      if (split.fold[i] == f) out.row.push_back(fit[i]);
    out.folds.push_back({begin, static_cast<Eigen::Index>(out.row.size())});
  }
  out.held.begin = static_cast<Eigen::Index>(out.row.size());
  out.row.insert(out.row.end(), held.begin(), held.end());
  out.held.end = static_cast<Eigen::Index>(out.row.size());
}

NoiseScale noise_scale(const NoiseFloor& floor, double sigma_m) {
  NoiseScale out;
  const double sigma = std::max(floor.sigma_m, kSmallestSigma_m);
  if (floor.source == NoiseFloor::Source::kNone) return out;
  out.known = true;
  out.variance = std::pow(sigma / sigma_m, 2);
  out.dof = trusted_dof(floor);
  return out;
}

/// 1 sigma by which orientations are divided [rad]; 0: the fit does not use them. The variance of a
/// whitened line is the same for points and orientations: where the points scatter by more or less
/// than is stated, `noise` says so, and the sigma of orientations follows. Where repeats tell their
/// scatter, that counts, not the larger sigma that a fit uses while the model lacks something.
double sigma_of_orientations(const Cell& cell, const Measurements& measured,
                             const NoiseScale& noise) {
  return orientation_floor(cell, measured).sigma_rad / std::sqrt(noise.variance);
}

/// 1 sigma of every line [m, rad], in the order of the lines.
std::vector<double> sigma_of_lines(const WhitenedFit& s, const Rows3& sigma_m, double sigma_rad) {
  std::vector<double> out;
  for (std::size_t i = 0; i < s.row.size(); ++i)
    s.reading[i].components(
        [&](int k) { out.push_back(k < 3 ? sigma_m(s.row[i], k) : sigma_rad); });
  return out;
}

/// Mean of the sigmas of the measured coordinates of points [m].
double mean_sigma(const WhitenedFit& s, const Rows3& sigma_m) {
  double sum = 0.0;
  int lines = 0;
  for (const int row : s.row) {
    const Reading point(*s.measured, row, false);
    point.components([&](int k) { sum += sigma_m(row, k); });
    lines += point.lines();
  }
  return sum / static_cast<double>(std::max(1, lines));
}

void look(const ArmState& state, WhitenedFit& out) {
  out.chain = Chain(state.arm.calibrated);
  out.sensors = out.measured->context.sensors;
  if (out.sensors.size() > format::kMaxTemperatures) out.sensors.resize(format::kMaxTemperatures);
  const Transformd X_TF = from_pose(state.arm.calibrated.tool).inverse();
  const auto count = static_cast<std::size_t>(out.poses());
  out.frames.resize(count);
  out.loads.resize(count);
  out.context.resize(count);
  out.arm_B.resize(count);
  out.X_MB.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    out.chain.frames(out.q(static_cast<Eigen::Index>(i)), out.frames[i]);
    const int setup = setup_of(*out.measured, out.row[i]);
    const Transformd X_MB = from_pose(state.frame(setup));
    out.X_MB[i] = X_MB;
    out.context[i] = context_of(*out.measured, out.row[i], out.sensors, X_MB);
    weigh(out.chain, out.frames[i], state.arm.mechanics, state.arm.gravity, X_TF,
          out.context[i].known, out.loads[i]);
    out.arm_B[i] = out.frames[i].tip.R * from_pose(state.target(setup)).p;
  }
}

void fill_carriers(WhitenedFit& s) {
  const Eigen::Index lines = s.table.lines();
  s.joint.assign(s.joints(), Eigen::VectorXd(lines));
  s.base.resize(lines, 6);
  s.tool.resize(lines, 3);
  const Vector3 none = Vector3::Zero();
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const Matrix3& R_MB = s.X_MB[static_cast<std::size_t>(i)].R;
    const Vector3 target_M = s.target_M(i);
    const auto& f = s.frames[i];
    const auto put = [&](const Vector3& shift, const Vector3& turn, auto&& all_lines) {
      auto lines_of_pose = all_lines.segment(s.table.begin(i), s.table.count(i));
      s.reading[static_cast<std::size_t>(i)].project(target_M, R_MB * shift, R_MB * turn,
                                                     lines_of_pose);
      whiten(s, i, lines_of_pose);
    };
    const Vector3 target = f.tip.p + s.arm_B[i];
    for (int j = 0; j < s.joints(); ++j) {
      const Vector3 axis = f.joint[j].R.col(2) * s.chain.scale(j);
      if (s.chain.revolute(j))
        put(cross<double>(axis, target - f.joint[j].p), axis, s.joint[j]);
      else
        put(axis, none, s.joint[j]);
    }
    for (int k = 0; k < 3; ++k) {
      Vector3 e = Vector3::Zero();
      e(k) = 1.0;
      put(e, none, s.base.col(k));
      put(cross<double>(e, target), e, s.base.col(3 + k));
      put(f.tip.R * e, none, s.tool.col(k));
    }
  }
}

}  // namespace

Eigen::VectorXd clear_residual(WhitenedFit& s) {
  Eigen::VectorXd left = s.U.topRows(s.fit_lines).transpose() * s.y.head(s.fit_lines);
  s.y -= s.U * left;
  s.Q = s.y.head(s.fit_lines).squaredNorm();
  return left;
}

namespace {

/// The parameters and the first waves of every series, because a smooth law may be confounded with
/// them. The other waves of a series resemble no law, and their prior limits them.
std::vector<Parameter> with_smooth_waves(const ArmState& state, std::vector<Parameter> parameters) {
  for (const auto& series : series_numbers(state.arm))
    for (int k = 0; k < std::min(series.count, static_cast<int>(2 * kSmoothWaves)); ++k)
      parameters.push_back({Parameter::Kind::kEffect, series.effect, series.first + k, ""});
  return parameters;
}

/// Residual and model columns of all rows; the columns made orthonormal over the fit lines.
void clear_of_model(const Calibration& calibration, const Rows3& sigma_m, double sigma_rad,
                    WhitenedFit& s) {
  FitData data;
  data.measured = s.measured;
  data.rows = s.row;
  data.sigma_m = sigma_m;
  data.sigma_rad = sigma_rad;
  data.touches = touch_density(*s.measured, s.row, calibration.state, calibration.parameters);
  const Solution at = evaluate(data, calibration.state,
                               with_smooth_waves(calibration.state, calibration.parameters));
  s.y = at.residual;
  s.fit_lines = s.table.begin(s.fit_poses());
  auto [U, half] = orthonormal(at.jacobian, s.fit_lines);
  s.rank = U.cols();
  s.U = std::move(U);
  s.half_information = std::move(half);
  s.correction = Eigen::VectorXd::Zero(s.half_information.rows());
  clear_residual(s);
}

/// Sum over the lines of each pose.
template <class Product>
Eigen::MatrixXd by_pose(const Product& lines, const LineTable& table) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(table.readings(), lines.cols());
  for (Eigen::Index c = 0; c < lines.cols(); ++c)
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      double sum = 0.0;
      for (Eigen::Index line = table.begin(i); line < table.begin(i + 1); ++line)
        sum += lines(line, c);
      out(i, c) = sum;
    }
  return out;
}

}  // namespace

void whiten(const WhitenedFit& s, Eigen::Index pose, Eigen::Ref<Eigen::VectorXd> lines) {
  for (Eigen::Index k = 0; k < lines.size(); ++k) lines(k) /= s.sigma[s.table.begin(pose) + k];
  if (!s.root.empty()) s.root[pose].triangularView<Eigen::Lower>().solveInPlace(lines);
}

void unwhiten(const WhitenedFit& s, Eigen::Index pose, Eigen::Ref<Eigen::VectorXd> lines) {
  if (!s.root.empty())
    lines = (s.root[pose].triangularView<Eigen::Lower>() * Eigen::VectorXd(lines)).eval();
  for (Eigen::Index k = 0; k < lines.size(); ++k) lines(k) *= s.sigma[s.table.begin(pose) + k];
}

void fold_joints(WhitenedFit& s) {
  s.joint_square.clear();
  s.joint_y.clear();
  s.joint_U.clear();
  for (int j = 0; j < s.joints(); ++j) {
    s.joint_square.push_back(by_pose(s.joint[j].cwiseAbs2(), s.table));
    s.joint_y.push_back(by_pose(s.joint[j].cwiseProduct(s.y), s.table));
    const Eigen::MatrixXd product = s.joint[j].asDiagonal() * s.U;
    s.joint_U.push_back(by_pose(product, s.table));
  }
}

WhitenedFit make_whitened_fit(const Cell& cell, const Measurements& measured,
                              const Calibration& calibration, const std::vector<int>& fit,
                              const std::vector<int>& held) {
  WhitenedFit out;
  out.cell = &cell;
  out.measured = &measured;
  deal(measured, fit, held, out);
  const Rows3 sigma_m = stated_sigma(cell, measured);
  out.sigma_m = mean_sigma(out, sigma_m);
  out.noise = noise_scale(noise_floor(cell, measured, calibration.state), out.sigma_m);
  const double sigma_rad = sigma_of_orientations(cell, measured, out.noise);
  std::vector<int> counts;
  for (const int row : out.row) {
    out.reading.emplace_back(measured, row, sigma_rad > 0.0);
    counts.push_back(out.reading.back().lines());
  }
  out.table = LineTable(counts);
  out.sigma = sigma_of_lines(out, sigma_m, sigma_rad);
  look(calibration.state, out);
  clear_of_model(calibration, sigma_m, sigma_rad, out);
  for (const Outlier& outlier : calibration.outliers) out.contradicted_m.push_back(outlier.error_m);
  fill_carriers(out);
  fold_joints(out);
  return out;
}

}  // namespace plumb::offline

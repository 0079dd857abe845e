// SPDX-License-Identifier: Apache-2.0
#include "diagnose/stage.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/noise_floor.hpp"
#include "fit/solver.hpp"
#include "fit/split.hpp"
#include "fit/weights.hpp"
#include "plumb/runtime/effect_set.hpp"

namespace plumb::offline {
namespace {

constexpr int kManyPoses = 100;  // fewer poses: more folds
constexpr int kFolds = 6, kManyFolds = 10;
constexpr double kStatedDof = 4.0;  // how far a stated sigma is believed
constexpr double kSmallestSigma_m = 0.1e-6;
constexpr double kIndependent = 1e-9;

/// Rows by fold; repeats of a pose share one.
void deal(const Measurements& measured, const std::vector<int>& fit, const std::vector<int>& held,
          Stage& out) {
  const Measurements some = pick(measured, fit);
  HeldOutRule rule;
  rule.kind = HeldOutRule::Kind::kFolds;
  const int groups = [&] {
    std::vector<int> all = some.replicate_group;
    std::sort(all.begin(), all.end());
    return static_cast<int>(std::unique(all.begin(), all.end()) - all.begin());
  }();
  rule.folds = std::min(groups, groups < kManyPoses ? kManyFolds : kFolds);
  const Split split = split_poses(some, rule, out.cell->measurement.seed);
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
  out.dof = floor.dof > 0 ? floor.dof : kStatedDof;
  return out;
}

void look(const ArmState& state, Stage& out) {
  out.chain = Chain(state.arm.calibrated);
  out.X_MB = from_pose(state.X_MB);
  out.sensors = out.measured->context.sensors;
  if (out.sensors.size() > format::kMaxTemperatures) out.sensors.resize(format::kMaxTemperatures);
  const Transformd X_TF = from_pose(state.arm.calibrated.tool).inverse();
  const auto count = static_cast<std::size_t>(out.poses());
  out.frames.resize(count);
  out.loads.resize(count);
  out.context.resize(count);
  out.arm_B.resize(count);
  const Transformd X_TG = from_pose(state.X_TG);
  for (std::size_t i = 0; i < count; ++i) {
    out.chain.frames(out.q(static_cast<Eigen::Index>(i)), out.frames[i]);
    out.context[i] = context_of(*out.measured, out.row[i], out.sensors, out.X_MB);
    weigh(out.chain, out.frames[i], state.arm.mechanics, state.arm.gravity, X_TF, out.context[i],
          out.loads[i]);
    out.arm_B[i] = out.frames[i].tip.R * X_TG.p;
  }
}

/// Writes a motion of the target (measurement frame) into the lines of one pose, whitened.
template <class Lines>
void put(const Stage& s, Eigen::Index pose, const Vector3& v_M, Lines&& lines) {
  Eigen::Index line = pose * s.axes;
  for (int k = 0; k < 3; ++k)
    if (s.measured->has_axis[k]) {
      lines(line) = v_M(k) / s.sigma[line];
      ++line;
    }
}

void fill_carriers(Stage& s) {
  const Eigen::Index lines = s.poses() * s.axes;
  s.joint.assign(s.joints(), Eigen::VectorXd(lines));
  s.base.resize(lines, 6);
  s.tool.resize(lines, 3);
  const Matrix3& R_MB = s.X_MB.R;
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const auto& f = s.frames[i];
    const Vector3 target = f.tip.p + s.arm_B[i];
    for (int j = 0; j < s.joints(); ++j) {
      const Vector3 axis = f.joint[j].R.col(2) * s.chain.scale(j);
      const Vector3 v = s.chain.revolute(j) ? cross<double>(axis, target - f.joint[j].p) : axis;
      put(s, i, R_MB * v, s.joint[j]);
    }
    for (int k = 0; k < 3; ++k) {
      Vector3 e = Vector3::Zero();
      e(k) = 1.0;
      put(s, i, R_MB * e, s.base.col(k));
      put(s, i, R_MB * cross<double>(e, target), s.base.col(3 + k));
      put(s, i, R_MB * (f.tip.R * e), s.tool.col(k));
    }
  }
}

/// Residual and model columns of all rows; the columns made orthonormal over the fit lines.
void clear_of_model(const Calibration& calibration, Stage& s, const Rows3& sigma_m) {
  FitData data;
  data.measured = s.measured;
  data.rows = s.row;
  data.sigma_m = sigma_m;
  const Solution at = evaluate(data, calibration.state, calibration.parameters);
  s.y = at.residual;
  s.fit_lines = s.fit_poses() * s.axes;
  const Eigen::MatrixXd& J = at.jacobian;
  const Eigen::VectorXd scale =
      J.topRows(s.fit_lines).colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled.topRows(s.fit_lines));
  qr.setThreshold(kIndependent);
  s.rank = qr.rank();
  s.U = (scaled * qr.colsPermutation()).leftCols(s.rank);
  const Eigen::MatrixXd R = qr.matrixQR().topLeftCorner(s.rank, s.rank);
  R.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(s.U);
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(J.cols(), s.rank);
  half.topRows(s.rank) =
      R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(s.rank, s.rank));
  half = scale.asDiagonal() * (qr.colsPermutation() * half);
  s.inverse_information = half * half.transpose();
  const auto U_fit = s.U.topRows(s.fit_lines);
  const Eigen::VectorXd left = U_fit.transpose() * s.y.head(s.fit_lines);
  s.y -= s.U * left;
  s.Q = s.y.head(s.fit_lines).squaredNorm();
}

/// Sum over the lines of each pose.
template <class Product>
Eigen::MatrixXd by_pose(const Product& lines, int axes) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(lines.rows() / axes, lines.cols());
  for (Eigen::Index c = 0; c < lines.cols(); ++c)
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      double sum = 0.0;
      for (int k = 0; k < axes; ++k) sum += lines(i * axes + k, c);
      out(i, c) = sum;
    }
  return out;
}

}  // namespace

void fold_joints(Stage& s) {
  s.joint_square.clear();
  s.joint_y.clear();
  s.joint_U.clear();
  for (int j = 0; j < s.joints(); ++j) {
    s.joint_square.push_back(by_pose(s.joint[j].cwiseAbs2(), s.axes));
    s.joint_y.push_back(by_pose(s.joint[j].cwiseProduct(s.y), s.axes));
    const Eigen::MatrixXd product = s.joint[j].asDiagonal() * s.U;
    s.joint_U.push_back(by_pose(product, s.axes));
  }
}

Stage make_stage(const Cell& cell, const Measurements& measured, const Calibration& calibration,
                 const std::vector<int>& fit, const std::vector<int>& held) {
  Stage out;
  out.cell = &cell;
  out.measured = &measured;
  out.axes = static_cast<int>(std::count(measured.has_axis.begin(), measured.has_axis.end(), true));
  deal(measured, fit, held, out);
  const Rows3 sigma_m = stated_sigma(cell, measured);
  double sum = 0.0;
  for (int row : out.row)
    for (int k = 0; k < 3; ++k)
      if (measured.has_axis[k]) {
        out.sigma.push_back(sigma_m(row, k));
        sum += sigma_m(row, k);
      }
  out.sigma_m = sum / static_cast<double>(std::max<std::size_t>(1, out.sigma.size()));
  look(calibration.state, out);
  clear_of_model(calibration, out, sigma_m);
  fill_carriers(out);
  fold_joints(out);
  out.noise = noise_scale(noise_floor(cell, measured, calibration.state), out.sigma_m);
  return out;
}

}  // namespace plumb::offline

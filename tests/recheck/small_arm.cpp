// SPDX-License-Identifier: Apache-2.0
#include "small_arm.hpp"

#include <cmath>
#include <string>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "tests/runtime/random_arm.hpp"

namespace plumb::offline::recheck {

double normal(tests::Random& random) {
  return std::sqrt(-2.0 * std::log(random.uniform(1e-15, 1.0))) *
         std::cos(2.0 * M_PI * random.uniform(0.0, 1.0));
}

SmallArm::SmallArm() {
  const double h = test::kPi / 2;
  cell.nominal =
      test::chain_of(format::Convention::kStandard,
                     {test::row(h, 0.05, 0.3), test::row(0.1, 0.4, 0.02), test::row(h, 0.3, 0.1)});
  for (std::size_t j = 0; j < 3; ++j) cell.nominal.joints[j].name = "J" + std::to_string(j + 1);
  cell.mechanics.resize(3);
  cell.assumed_limits.assign(3, false);
  cell.measurement.sigma_m = 1e-5;
  state.arm.calibrated = state.arm.nominal = cell.nominal;
  state.X_MB = {{1.0, -2.0, 0.5}, {0.5, 0.5, -0.5, 0.5}};
  state.X_TG.p = {0.05, 0.08, 0.1};
}

Measurements SmallArm::poses(int count, std::uint64_t seed) const {
  tests::Random random(seed);
  Measurements out;
  out.q.resize(count, 3);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < 3; ++j) out.q(i, j) = random.uniform(-2.5, 2.5);
    out.pose.push_back(std::to_string(i + 1));
    out.replicate_group.push_back(i);
    out.set.push_back(SetMark::kUnmarked);
  }
  out.p_M = predict_points(state, out);
  return out;
}

KnownNumbers SmallArm::known(double std_rad) const {
  KnownNumbers out;
  for (const char* name : {"J2.theta", "J3.theta"})
    out.parameters.push_back(*robot_parameter(cell.nominal, name));
  out.covariance = std_rad * std_rad * (Eigen::Matrix2d() << 1.0, 0.5, 0.5, 1.0).finished();
  return out;
}

Run SmallArm::run(const Measurements& own) const {
  Run out;
  Fit& fit = out.fit;
  const KnownNumbers numbers = known(2e-5);
  fit.calibration.state = state;
  fit.calibration.parameters = numbers.parameters;
  fit.calibration.covariance = numbers.covariance;
  fit.calibration.estimates = estimates_of(state, state, numbers.parameters, numbers.covariance);
  fit.split.held.assign(static_cast<std::size_t>(own.size()), false);
  fit.split.used.assign(static_cast<std::size_t>(own.size()), true);
  fit.split.fold.assign(static_cast<std::size_t>(own.size()), -1);
  return out;
}

Change SmallArm::tool() const {
  Change out{.part = Part::kTool, .effect = "target", .scales = {0.1, 1.0}, .chance = 0.3};
  for (const char* name : {"target.x", "target.y", "target.z"})
    out.parameters.push_back(*placing_parameter(name));
  out.typical = Eigen::Vector3d::Constant(1e-3);
  return out;
}

Change SmallArm::offset(int joint) const {
  Change out{.part = Part::kJoint,
             .joint = joint,
             .effect = "offset",
             .scales = {0.1, 1.0},
             .chance = 0.1};
  out.parameters.push_back(
      *robot_parameter(cell.nominal, "J" + std::to_string(joint + 1) + ".theta"));
  out.typical = Eigen::VectorXd::Constant(1, 1e-3);
  return out;
}

Readings readings_of(Measurements rows, double sigma_m) {
  Readings out;
  out.rows = std::move(rows);
  out.axes = axes_of(out.rows);
  out.poses = out.rows.size();
  out.noise_m = sigma_m;
  out.expected.push_back({Rows3::Zero(out.poses, 3),
                          sigma_m * sigma_m * Eigen::MatrixXd::Identity(out.lines(), out.lines())});
  return out;
}

void add_noise(Measurements& rows, double sigma_m, tests::Random& random) {
  for (double& p : rows.p_M.reshaped()) p += sigma_m * normal(random);
}

Eigen::VectorXd missed_lines(const Measurements& rows, const ArmState& state) {
  const Rows3 missed = rows.p_M - predict_points(state, rows);
  Eigen::VectorXd out(rows.size() * axes_of(rows));
  Eigen::Index line = 0;
  for (Eigen::Index i = 0; i < missed.rows(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (rows.has_axis[static_cast<std::size_t>(k)]) out(line++) = missed(i, k);
  return out;
}

Eigen::MatrixXd slopes(const Measurements& rows, const ArmState& state,
                       const std::vector<Parameter>& parameters) {
  constexpr double kStep = 1e-5;
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd out(rows.size() * axes_of(rows), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(count, k);
    out.col(k) = (missed_lines(rows, moved(state, parameters, -step)) -
                  missed_lines(rows, moved(state, parameters, step))) /
                 (2.0 * kStep);
  }
  return out;
}

Eigen::MatrixXd correlated(Eigen::Index size, double variance, tests::Random& random) {
  Eigen::MatrixXd A(size, 2 * size);
  for (double& a : A.reshaped()) a = random.uniform(-1.0, 1.0);
  A.rowwise().normalize();
  return variance * A * A.transpose();
}

}  // namespace plumb::offline::recheck

// SPDX-License-Identifier: Apache-2.0
#include "plan/design_space.hpp"

#include <cmath>
#include <numeric>

#include "cell/random.hpp"
#include "effects/registry.hpp"
#include "solve/evaluation.hpp"

namespace plumb::offline {
namespace {

/// 1 sigma of a parameter of the arm [m] or [rad], and of the motion by an effect [m].
constexpr double kPlausible = 5e-3;
/// 1 sigma of frame and target [m] or [rad].
constexpr double kAnywhere = 1.0;
/// A parameter that moves the points by less [m] per `width` is left out.
constexpr double kMoves = 1e-9;
/// Numbers of a series at each joint that a plan looks at: sine and cosine of its first four waves.
constexpr int kFirstNumbers = 8;
/// Temperature where none was measured.
constexpr double kRoom_degC = 20.0;

double mean_of(const Eigen::VectorXd& values) {
  double sum = 0.0, count = 0.0;
  for (const double v : values)
    if (!std::isnan(v)) sum += v, count += 1.0;
  return count > 0.0 ? sum / count : kRoom_degC;
}

/// True for the higher waves of a series: their prior holds them, since a plan need not show
/// hundreds of numbers.
bool is_held_by_its_prior(const format::Model& arm, const Parameter& p) {
  const format::Effect& effect = arm.effects[static_cast<std::size_t>(p.joint)];
  if (!is_series(effect.name)) return false;
  const auto each = static_cast<int>(effect.parameters.size() / effect.joints.size());
  return p.component % each >= kFirstNumbers;
}

}  // namespace

int DesignSpace::per_pose() const {
  return int{has_axis[0]} + int{has_axis[1]} + int{has_axis[2]} + (sigma_rad > 0.0 ? 3 : 0);
}

Eigen::MatrixXd DesignSpace::lines(const Measurements& at) const {
  if (at.size() == 0) return Eigen::MatrixXd(0, size());
  FitData data;
  data.measured = &at;
  data.rows.resize(static_cast<std::size_t>(at.size()));
  std::iota(data.rows.begin(), data.rows.end(), 0);
  data.sigma_m = Rows3::Constant(at.size(), 3, sigma_m);
  data.sigma_rad = sigma_rad;
  return evaluate(data, state, parameters).jacobian * width.asDiagonal();
}

std::vector<Eigen::Index> DesignSpace::columns_of_effect(int effect) const {
  std::vector<Eigen::Index> out;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].of_effect() && parameters[i].joint == effect)
      out.push_back(static_cast<Eigen::Index>(i));
  return out;
}

DesignSpace design_space(const Cell& cell, const ArmState& state, const Measurements& typical,
                         double sigma_m, double sigma_rad) {
  DesignSpace out{.cell = &cell,
                  .state = state,
                  .parameters = candidate_parameters(
                      cell, sigma_rad > 0.0 ? Orientation::kUsed : Orientation::kIgnored),
                  .width = {},
                  .sigma_m = 1.0,
                  .sigma_rad = sigma_rad > 0.0 ? 1.0 : 0.0,
                  .has_axis = typical.has_axis};
  for (const auto& parameter : effect_parameters(state.arm))
    if (!is_held_by_its_prior(state.arm, parameter)) out.parameters.push_back(parameter);
  out.width = Eigen::VectorXd::Ones(out.size());
  const Eigen::MatrixXd J = out.lines(typical);
  std::vector<Parameter> kept;
  std::vector<double> width;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const Parameter& p = out.parameters[static_cast<std::size_t>(i)];
    const double rms = J.col(i).norm() / std::sqrt(static_cast<double>(typical.size()));
    const double as_one = p.of_effect()  ? kPlausible / std::max(rms, 1e-300)
                          : p.of_robot() ? kPlausible
                                         : kAnywhere;
    // What is planned will be measured in the first set-up; poses of the others still tell of the
    // arm only what their own frames and reflectors leave.
    const bool elsewhere = p.setup > 0;
    if (!elsewhere && (rms <= 1e-300 || rms * as_one < kMoves)) continue;
    kept.push_back(p);
    width.push_back(as_one);
  }
  out.parameters = std::move(kept);
  out.width = Eigen::Map<Eigen::VectorXd>(width.data(), static_cast<Eigen::Index>(width.size()));
  out.sigma_m = sigma_m;
  out.sigma_rad = sigma_rad;
  return out;
}

Measurements imagined(const Cell& cell, const Measurements& measured, const RowsN& q,
                      std::uint64_t seed) {
  Random random(seed);
  const Eigen::Index n = q.rows(), joints = q.cols();
  Measurements out;
  out.q = q;
  out.p_M = Rows3::Zero(n, 3);
  out.has_axis = measured.has_axis;
  if (measured.has_orientation()) {
    out.quat_M = Rows4::Zero(n, 4);
    out.quat_M.col(0).setOnes();
  }
  auto& c = out.context;
  c.direction.resize(n, joints);
  c.step.resize(n, joints);
  for (double& d : c.direction.reshaped()) d = random.unit() < 0.5 ? -1.0 : 1.0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < joints; ++j) c.step(i, j) = random.unit() * c.direction(i, j);
  c.payload = RowsN::Constant(n, 4, cell.payload.mass_kg);
  for (int k = 0; k < 3; ++k)
    c.payload.col(1 + k).setConstant(cell.payload.com_m[static_cast<std::size_t>(k)]);
  c.wrench = RowsN::Zero(n, 6);
  c.sensors = measured.context.sensors;
  if (c.sensors.empty()) c.sensors = {"temp"};
  c.temperature = RowsN::Constant(n, static_cast<Eigen::Index>(c.sensors.size()), kRoom_degC);
  for (Eigen::Index k = 0; k < measured.context.temperature.cols(); ++k)
    c.temperature.col(k).setConstant(mean_of(measured.context.temperature.col(k)));
  const auto& time = measured.context.time_s;
  c.time_s = Eigen::VectorXd::Constant(n, time.size() > 0 ? time.maxCoeff() : 0.0);
  c.order = Eigen::VectorXd::Constant(n, static_cast<double>(measured.size()));
  for (Eigen::Index i = 0; i < n; ++i) out.pose.push_back(std::to_string(i + 1));
  return out;
}

Measurements nothing_measured(const Cell& cell) {
  Measurements out;
  out.q.resize(0, cell.joints());
  out.p_M.resize(0, 3);
  if (cell.measurement.sigma_rad) out.quat_M.resize(0, 4);
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "simulate/simulate.hpp"

namespace plumb::offline {

inline constexpr double kPi = std::numbers::pi;

/// One revolute joint about z, a link of 1 m along x, weight pulling along -y; the base is the
/// measurement frame and the flange is measured: dq is the angle of the point, minus q.
inline Cell one_joint() {
  Cell cell;
  format::JointRow row;
  row.name = "J1";
  row.a = 1.0;
  row.q_min = -kPi;
  row.q_max = kPi;
  cell.nominal.joints = {row};
  cell.mechanics.resize(1);
  cell.mechanics[0].link_mass_kg = 0.0;
  cell.mechanics[0].link_com_m = {0.0, 0.0, 0.0};
  cell.gravity = {0.0, -9.81, 0.0};
  cell.measurement.fit_frame = false;
  cell.measurement.fit_target = false;
  return cell;
}

inline SimulationPlan noise_free(const std::vector<double>& q, const std::string& effect) {
  SimulationPlan plan;
  plan.q.resize(static_cast<Eigen::Index>(q.size()), 1);
  for (std::size_t row = 0; row < q.size(); ++row)
    plan.q(static_cast<Eigen::Index>(row), 0) = q[row];
  plan.noise_m = 0.0;
  if (!effect.empty()) plan.truth.effects = {effect};
  return plan;
}

/// Joint error seen at each row [rad].
inline std::vector<double> joint_error(const Simulation& simulation) {
  std::vector<double> out;
  for (int row = 0; row < simulation.measured.size(); ++row) {
    const auto p = simulation.measured.p_M.row(row);
    out.push_back(std::remainder(std::atan2(p(1), p(0)) - simulation.measured.q(row, 0), 2 * kPi));
  }
  return out;
}

/// Numbers of the first hidden effect in the truth file.
inline nlohmann::json first_effect(const Simulation& simulation) {
  return nlohmann::json::parse(simulation.truth_json)["effects"][0]["numbers"];
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "simulate/arm_rows.hpp"

#include <numbers>

namespace plumb::offline::sim {

Cell cell_from_sheet(format::Convention convention, const std::vector<SheetRow>& rows,
                     double tool_mm) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kMillimetre = 1e-3;
  Cell cell;
  cell.nominal.convention = convention;
  for (const auto& sheet : rows) {
    const double unit = sheet.type == format::JointType::kRevolute ? kDegree : kMillimetre;
    format::JointRow row;
    row.name = "J" + std::to_string(cell.nominal.joints.size() + 1);
    row.type = sheet.type;
    row.alpha = sheet.alpha_deg * kDegree;
    row.a = sheet.a_mm * kMillimetre;
    row.d = sheet.d_mm * kMillimetre;
    row.theta = sheet.theta_deg * kDegree;
    row.q_min = sheet.q_min * unit;
    row.q_max = sheet.q_max * unit;
    cell.nominal.joints.push_back(row);
    JointMechanics mechanics;
    mechanics.parallel_next = sheet.parallel_next;
    cell.mechanics.push_back(mechanics);
  }
  cell.nominal.tool.p = {0.0, 0.0, tool_mm * kMillimetre};
  cell.measurement.files = {"measurements.csv"};
  cell.measurement.sigma_m = 10e-6;
  EffectEntry geometry;
  geometry.name = "geometry";
  cell.effects = {geometry};
  return cell;
}

}  // namespace plumb::offline::sim

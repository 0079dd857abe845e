// SPDX-License-Identifier: Apache-2.0
#include "simulate/study_arms.hpp"

#include <cmath>

#include "simulate/arm.hpp"
#include "simulate/arm_rows.hpp"

namespace plumb::offline::sim {

using format::Convention;

namespace {

const std::vector<SheetRow>& heavy_rows() {
  static const std::vector<SheetRow> rows{{0, 0, 642, 0, -180, 180},
                                          {.alpha_deg = -90,
                                           .a_mm = 250,
                                           .d_mm = 450,
                                           .theta_deg = -90,
                                           .q_min = -115,
                                           .q_max = 120,
                                           .parallel_next = true},
                                          {0, 950, -450, 90, -140, 145},
                                          {90, 0, 800, 0, -180, 180},
                                          {-90, 0, 0, 0, -120, 120},
                                          {90, 0, 194, 0, -180, 180}};
  return rows;
}

}  // namespace

Cell heavy_arm() { return cell_from_sheet(Convention::kModified, heavy_rows(), 150); }

Cell track_arm() {
  std::vector<SheetRow> rows = heavy_rows();
  rows.front().alpha_deg = 90;
  rows.insert(
      rows.begin(),
      {.alpha_deg = -90, .q_min = -1500, .q_max = 1500, .type = format::JointType::kPrismatic});
  return cell_from_sheet(Convention::kModified, rows, 150);
}

Cell scara_arm() {
  return cell_from_sheet(
      Convention::kStandard,
      {{.a_mm = 400, .d_mm = 350, .q_min = -130, .q_max = 130, .parallel_next = true},
       {.alpha_deg = 180, .a_mm = 350, .q_min = -145, .q_max = 145, .parallel_next = true},
       {.q_min = 20, .q_max = 220, .type = format::JointType::kPrismatic, .parallel_next = true},
       {.d_mm = 40, .q_min = -180, .q_max = 180}},
      80);
}

Cell palletiser_arm() {
  return cell_from_sheet(
      Convention::kModified,
      {{0, 0, 800, 0, -170, 170},
       {.alpha_deg = -90,
        .a_mm = 350,
        .theta_deg = -90,
        .q_min = -40,
        .q_max = 85,
        .parallel_next = true},
       {.a_mm = 1250, .theta_deg = 90, .q_min = -70, .q_max = 60, .parallel_next = true},
       {.a_mm = 1200, .q_min = -180, .q_max = 180},
       {.alpha_deg = -90, .a_mm = 250, .d_mm = 200, .q_min = -180, .q_max = 180}},
      100);
}

Cell light_arm() {
  return cell_from_sheet(Convention::kStandard,
                         {{90, 0, 127.3, 0, -180, 180},
                          {.a_mm = -612, .q_min = -180, .q_max = 0, .parallel_next = true},
                          {.a_mm = -572.3, .q_min = -150, .q_max = 150, .parallel_next = true},
                          {90, 0, 163.9, 0, -180, 180},
                          {-90, 0, 115.7, 0, -180, 180},
                          {0, 0, 92.2, 0, -180, 180}},
                         120);
}

void state_masses(Cell& cell, double moving_kg) {
  constexpr double kRatio = 0.6;  // ratio of the masses of successive links
  const Arm arm(cell.nominal);
  const int n = arm.joints();
  double mass = moving_kg * (1.0 - kRatio) / (1.0 - std::pow(kRatio, n));
  for (int i = 0; i < n; ++i, mass *= kRatio) {
    const Vector3d com = 0.45 * arm.link_vector(i, VectorXd::Zero(n));
    auto& link = cell.mechanics[static_cast<std::size_t>(i)];
    link.link_mass_kg = std::round(mass * 10.0) / 10.0;
    link.link_com_m = {com.x(), com.y(), com.z()};
  }
}

}  // namespace plumb::offline::sim

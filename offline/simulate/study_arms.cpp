// SPDX-License-Identifier: Apache-2.0
#include "simulate/study_arms.hpp"

#include <cmath>

#include "simulate/arm.hpp"
#include "simulate/arm_rows.hpp"

namespace plumb::offline::sim {

using format::Convention;

Cell heavy_arm() {
  return cell_from_sheet(Convention::kModified,
                         {{0, 0, 642, 0, -180, 180},
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
                          {90, 0, 194, 0, -180, 180}},
                         150);
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

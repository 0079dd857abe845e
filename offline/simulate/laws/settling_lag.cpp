// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// The joints were read before the arm was at rest. All joints move as long as the one with the
// longest way, and a controller brakes harder at the end of long moves than of short ones:
//   dq_j = -size step_j / max_k |step_k| (1 - exp(-|step_j| / s))
// A repeated reading of a pose has the joint values of the same stop, with the same error.
MadeLaw make_settling_lag(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualLag_rad = 100e-6;
  constexpr double kLongMove_rad = 20.0 * std::numbers::pi / 180.0;
  std::vector<JointError> out;
  for (const auto& at :
       sized_joints(effect, world, turning(world), turning(world), kUsualLag_rad, "it slides")) {
    out.push_back({at,
                   [=](const Moment& now) {
                     const VectorXd step = now.visit.q - now.visit.before;
                     const double longest = step.cwiseAbs().maxCoeff();
                     if (longest == 0.0) return 0.0;
                     const double s = step(at.joint);
                     return at.size * s / longest * std::expm1(-std::abs(s) / kLongMove_rad);
                   },
                   {{"long_move_deg", kLongMove_rad * 180.0 / std::numbers::pi}},
                   {"step" + std::to_string(at.joint + 1)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// Wrong couplings of the last three joints, whose bevel gears drive through one another, with a
// small error of the teeth:
//   dq5 = k45 (q4 + 0.05 sin 2 q4),  dq6 = k46 q4 + k56 (q5 + 0.05 sin 2 q5);  size: k45
MadeLaw make_wrist_coupling(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualWristCoupling_rad = 60e-6;
  constexpr double kTeeth = 0.05;  // error of the teeth, twice a turn, as a share of the coupling
  constexpr int kWristJoints = 3;  // behind at least two joints that move the wrist
  const int n = world.arm.joints();
  if (n < kWristJoints + 2) refuse(effect, "it has no wrist of three joints");
  for (int j = n - kWristJoints; j < n; ++j) {
    if (world.arm.slides(j)) refuse(effect, "a wrist joint slides");
  }
  Random random(world.seed, "wrist coupling");
  const double k45 = effect.size.value_or(kUsualWristCoupling_rad);
  const double k46 = k45 * random.uniform(-1.0, 1.0), k56 = k45 * random.uniform(-1.0, 1.0);
  const double teeth = kTeeth * world.richness;
  const auto through = [=](double q) { return q + teeth * std::sin(2.0 * q); };
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const double q4 = now.visit.q(n - 3), q5 = now.visit.q(n - 2);
    deflection.dq(n - 2) += k45 * through(q4);
    deflection.dq(n - 1) += k46 * q4 + k56 * through(q5);
  };
  out.truth = {{"k45_urad_per_rad", k45 * 1e6},
               {"k46_urad_per_rad", k46 * 1e6},
               {"k56_urad_per_rad", k56 * 1e6},
               {"teeth_share", teeth}};
  out.inputs = {angle_name(n - 3), angle_name(n - 2)};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

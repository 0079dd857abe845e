// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// The same wrong number of counts a turn at every joint that turns, as 4095 for 4096, with gears
// that differ a little, and an error of interpolation twice a turn:
//   dq_j = size (s_j q_j + 0.02 sin(2 q_j + p_j)), s_j from 0.9 to 1.1; size: error a radian
MadeLaw make_encoder_counts(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualCounts = 1.0 / 4096.0;
  constexpr double kSpread = 0.1, kInterpolation = 0.02;
  std::vector<JointError> out;
  for (const auto& at :
       sized_joints(effect, world, turning(world), turning(world), kUsualCounts, "it slides")) {
    Random random = joint_random(world, "encoder counts", at.joint);
    const double share = 1.0 + world.richness * random.uniform(-kSpread, kSpread);
    const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double interpolation = world.richness * kInterpolation;
    out.push_back({at,
                   [=](const Moment& now) {
                     const double q = now.visit.q(at.joint);
                     return at.size * (share * q + interpolation * std::sin(2.0 * q + phase));
                   },
                   {{"share", share}, {"phase_rad", phase}, {"twice_a_turn", interpolation}},
                   {angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

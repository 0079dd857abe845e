// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// An encoder with a wrong number of increments per turn and a slightly dished code wheel:
//   dq = +- size ((q - middle) + 0.03 (q - middle)^2); size: error a radian
MadeLaw make_encoder_scale(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualEccentricity_rad = 60e-6;
  constexpr double kDish = 0.03;
  constexpr int kUsualJoint = 2;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualEccentricity_rad, "it slides")) {
    const double dish = kDish * world.richness;
    const double middle = 0.5 * (world.q_min(at.joint) + world.q_max(at.joint));
    const double sign = joint_random(world, "encoder scale", at.joint).below(2) == 0 ? -1.0 : 1.0;
    out.push_back({at,
                   [=](const Moment& now) {
                     const double x = now.visit.q(at.joint) - middle;
                     return sign * at.size * (x + dish * x * x);
                   },
                   {{"sign", sign}, {"square_per_rad", dish}},
                   {angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

// A code wheel whose centre is e radii beside its axis, with a single reading head:
//   dq = atan2(e sin a, 1 + e cos a), a = q + phase; size: e
MadeLaw make_encoder_eccentricity(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualEccentricity_rad = 120e-6;
  constexpr int kUsualJoint = 2;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualEccentricity_rad, "it slides")) {
    Random random = joint_random(world, "eccentricity", at.joint);
    const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
    out.push_back({at,
                   [=](const Moment& now) {
                     const double a = now.visit.q(at.joint) + phase;
                     return std::atan2(at.size * std::sin(a), 1.0 + at.size * std::cos(a));
                   },
                   {{"cycles_per_turn", 1}, {"phase_rad", phase}},
                   {angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

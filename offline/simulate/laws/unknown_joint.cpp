// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

/// Joint errors that no effect of the library describes.
namespace plumb::offline::sim {
namespace {

constexpr double kUsualUnknownAngle_rad = 120e-6;

double any_phase(Random& random) { return random.uniform(-std::numbers::pi, std::numbers::pi); }

int second_last(const World& world) { return world.arm.joints() - 2; }

}  // namespace

// A joint error that depends on the product of functions of two other joints:
//   dq = size (sin(q_a + p_a) sin(q_b + p_b) + 0.1 sin(2 q_a + p_a) sin(2 q_b + p_b))
MadeLaw make_joint_product(const HiddenEffect& effect, const World& world) {
  constexpr double kSecond = 0.1;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, second_last(world)),
                                     kUsualUnknownAngle_rad, "it slides")) {
    Random random = joint_random(world, "joint product", at.joint);
    const int last = world.arm.joints() - 1;
    const int a = joint_number(effect, "a", world, at.joint > 0 ? at.joint - 1 : last);
    const int b = joint_number(effect, "b", world, at.joint < last ? at.joint + 1 : 0);
    if (a == b) refuse(effect, "it takes two different joints");
    const double pa = any_phase(random), pb = any_phase(random);
    out.push_back({at,
                   [=](const Moment& now) {
                     const double qa = now.visit.q(a), qb = now.visit.q(b);
                     return at.size * (std::sin(qa + pa) * std::sin(qb + pb) +
                                       kSecond * std::sin(2.0 * qa + pa) * std::sin(2.0 * qb + pb));
                   },
                   {{"phase_a_rad", pa}, {"phase_b_rad", pb}, {"second_share", kSecond}},
                   {angle_name(a), angle_name(b)}});
  }
  return joint_law(std::move(out));
}

// A joint error that depends on the angle of another joint: dq = size sin(h q_k + phase).
MadeLaw make_other_joint(const HiddenEffect& effect, const World& world) {
  constexpr int kUsualJoint = 2;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualUnknownAngle_rad, "it slides")) {
    Random random = joint_random(world, "other joint", at.joint);
    const int away = 1 + random.below(world.arm.joints() - 1);
    const int from = joint_number(effect, "from", world, (at.joint + away) % world.arm.joints());
    if (from == at.joint) refuse(effect, "the other joint is the same");
    const double h = number(effect, "cycles", 1.0 + random.below(3));
    const double phase = any_phase(random);
    out.push_back(
        {at,
         [=](const Moment& now) { return at.size * std::sin(h * now.visit.q(from) + phase); },
         {{"cycles_per_turn", h}, {"phase_rad", phase}},
         {angle_name(from)}});
  }
  return joint_law(std::move(out));
}

// A joint error that depends on the previous position of the joint:
//   dq = size sin(previous q_j + phase)
MadeLaw make_joint_memory(const HiddenEffect& effect, const World& world) {
  constexpr int kUsualJoint = 1;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualUnknownAngle_rad, "it slides")) {
    Random random = joint_random(world, "joint memory", at.joint);
    const double phase = any_phase(random);
    out.push_back(
        {at,
         [=](const Moment& now) { return at.size * std::sin(now.visit.before(at.joint) + phase); },
         {{"phase_rad", phase}},
         {"previous " + angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

// A zero position that moves as the drive warms up, where T is the temperature of the zone behind
// the joint:
//   dq = size T / 10 K
MadeLaw make_warm_encoder(const HiddenEffect& effect, const World& world) {
  constexpr int kUsualJoint = 2;
  constexpr double kWarm_K = 10.0;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualUnknownAngle_rad, "it slides")) {
    out.push_back(
        {at,
         [=](const Moment& now) { return at.size * now.visit.zone_K(at.joint + 1) / kWarm_K; },
         {{"urad_per_K", at.size * 1e6 / kWarm_K}},
         {"temp"}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

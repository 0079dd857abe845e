// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// The motor that moves a joint by a parallelogram stands on the link before: it turns with the
// angle of the joint against the horizontal, and so do its waves, which are stronger under load:
//   dq_j = size (1 + 0.15 x) (sin(k a + p0) + 0.15 sin(2 k a + p1)), a = q_(j-1) + q_j
// x: torque of the joint over the largest one; k: cycles a turn of a.
MadeLaw make_parallelogram_wave(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualWave_rad = 100e-6;
  constexpr double kSecondShare = 0.15, kUnderLoad = 0.15;
  constexpr int kUsualJoint = 2, kMostCycles = 6;
  std::vector<bool> possible = turning(world);
  for (std::size_t j = possible.size(); j-- > 0;)
    possible[j] = possible[j] && j > 0 && possible[j - 1];
  const VectorXd torque = largest_torque(world);
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, possible, only(world, kUsualJoint),
                                     kUsualWave_rad, "no joint turns before it")) {
    Random random = joint_random(world, "parallelogram wave", at.joint);
    const double k = number(effect, "cycles", 1.0 + random.below(kMostCycles));
    const double p0 = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double p1 = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double second = world.richness * kSecondShare, load = world.richness * kUnderLoad;
    const double most = torque(at.joint);
    out.push_back({at,
                   [=](const Moment& now) {
                     const double a = now.visit.q(at.joint - 1) + now.visit.q(at.joint);
                     const double x = most > 0.0 ? now.loads.torque(at.joint) / most : 0.0;
                     return at.size * (1.0 + load * x) *
                            (std::sin(k * a + p0) + second * std::sin(2.0 * k * a + p1));
                   },
                   {{"cycles_per_turn", k},
                    {"phase_rad", p0},
                    {"second_share", second},
                    {"load_share", most > 0.0 ? load : 0.0}},
                   {angle_name(at.joint - 1), angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

/// A spring between a pin on the column and a pin on the link. All lengths are divided by that of
/// the crank:
///   L^2 = 1 + p^2 + 2 p cos psi,  torque ~ p sin psi (1 - L0 / L)
struct SpringCrank {
  double pivot = 2.0;  // p
  double free = 1.2;   // L0
  double zero = 0.0;   // psi = q - zero
  double torque(double q) const {
    const double psi = q - zero;
    const double length = std::sqrt(1.0 + pivot * pivot + 2.0 * pivot * std::cos(psi));
    return pivot * std::sin(psi) * (1.0 - free / length);
  }
  double largest() const {
    constexpr int kSteps = 720;
    double most = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      most = std::max(most, std::abs(torque(2.0 * std::numbers::pi * k / kSteps)));
    }
    return most;
  }
};

}  // namespace

// The joint is deflected by the torque of its balancing spring, which the model does not contain.
MadeLaw make_gravity_compensator(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualSpring_rad = 120e-6;
  constexpr int kUsualJoint = 1;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualSpring_rad, "it slides")) {
    Random random = joint_random(world, "gravity compensator", at.joint);
    SpringCrank spring;
    spring.pivot = random.uniform(1.6, 3.0);
    spring.free = random.uniform(0.3, 0.8) * (spring.pivot - 1.0);
    spring.zero = 0.5 * (world.q_min(at.joint) + world.q_max(at.joint)) + random.uniform(-0.4, 0.4);
    const double most = spring.largest();
    out.push_back(
        {at,
         [=](const Moment& now) { return at.size * spring.torque(now.visit.q(at.joint)) / most; },
         {{"pivot_over_crank", spring.pivot},
          {"free_length_over_crank", spring.free},
          {"zero_rad", spring.zero}},
         {angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

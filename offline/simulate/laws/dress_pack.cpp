// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// Hoses that wind up around a wrist joint and rub. They are stiffer the further they are wound, and
// the friction depends on the direction from which the joint came:
//   x = (q - middle) / half range
//   dq = -size (0.35 x + 0.65 x^3 + 0.3 (1 + |x|) sgn(d) (1 - exp(-travel / 4 deg)))
MadeLaw make_dress_pack(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualPull_rad = 150e-6;
  constexpr double kTravel_rad = 4.0 * std::numbers::pi / 180.0;
  constexpr double kRubbing = 0.3, kLinear = 0.35;
  constexpr int kFromEnd = 3;
  std::vector<JointError> out;
  for (const auto& at :
       sized_joints(effect, world, turning(world), only(world, world.arm.joints() - kFromEnd),
                    kUsualPull_rad, "it slides")) {
    const double low = world.q_min(at.joint), high = world.q_max(at.joint);
    out.push_back({at,
                   [=](const Moment& now) {
                     const double x = (2.0 * now.visit.q(at.joint) - low - high) / (high - low);
                     const double turned = -std::expm1(-now.visit.travel(at.joint) / kTravel_rad);
                     const double rub =
                         (1.0 + std::abs(x)) * now.visit.direction(at.joint) * turned;
                     return -at.size * (kLinear * x + (1.0 - kLinear) * x * x * x + kRubbing * rub);
                   },
                   {{"linear_share", kLinear}, {"rubbing_share", kRubbing}},
                   {angle_name(at.joint), "dir" + std::to_string(at.joint + 1)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

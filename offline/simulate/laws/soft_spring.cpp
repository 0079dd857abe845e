// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// A gear that is compliant until its teeth are in contact: its stiffness increases smoothly with
// the torque.
//   d dq/dx = 1 + r / cosh^2(x / x1), so dq = size (x + r x1 tanh(x / x1)) / (1 + r x1 tanh(1 /
//   x1))
// x = torque / largest torque; size at x = 1.
MadeLaw make_soft_joint_compliance(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualTip_m = 0.2e-3;
  const VectorXd torque = largest_torque(world);
  std::vector<bool> loaded;
  for (int j = 0; j < torque.size(); ++j) loaded.push_back(torque(j) > 0.0);
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, loaded, loaded, kUsualTip_m / world.arm.reach(),
                                     "gravity does not turn it")) {
    Random random = joint_random(world, "soft spring", at.joint);
    const double extra = random.uniform(2.5, 5.0);
    const double seat = random.uniform(0.08, 0.2);
    const double most = torque(at.joint);
    const double whole = 1.0 + extra * seat * std::tanh(1.0 / seat);
    out.push_back({at,
                   [=](const Moment& now) {
                     const double x = now.loads.torque(at.joint) / most;
                     return at.size * (x + extra * seat * std::tanh(x / seat)) / whole;
                   },
                   {{"largest_torque_Nm", most},
                    {"stiffness_Nm_per_rad", most * whole / at.size},
                    {"softer_at_rest_by", 1.0 + extra},
                    {"seated_at_Nm", seat * most}}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

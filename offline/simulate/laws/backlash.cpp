// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {

// The torque decides which tooth flanks are in contact. The change is smooth, friction shifts it
// away from zero torque, and one flank yields more than the other:
//   s = tanh((x - x0) / w),  dq = size (s + a (1 + s) / 2),  x = torque / largest torque
// Plateaus: -size and size (1 + a).
MadeLaw make_backlash(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualPlay_rad = 80e-6;
  const VectorXd torque = largest_torque(world);
  std::vector<bool> loaded;
  for (int j = 0; j < torque.size(); ++j) loaded.push_back(torque(j) > 0.0);
  std::vector<JointError> out;
  for (const auto& at :
       sized_joints(effect, world, loaded, loaded, kUsualPlay_rad, "gravity does not turn it")) {
    Random random = joint_random(world, "backlash", at.joint);
    const double width = random.uniform(0.04, 0.12);
    const double centre = world.richness * random.uniform(-0.03, 0.03);
    const double more = world.richness * random.uniform(0.1, 0.3);
    const double most = torque(at.joint);
    out.push_back({at,
                   [=](const Moment& now) {
                     const double x = now.loads.torque(at.joint) / most;
                     const double side = std::tanh((x - centre) / width);
                     return at.size * (side + 0.5 * more * (1.0 + side));
                   },
                   {{"largest_torque_Nm", most},
                    {"width_Nm", width * most},
                    {"centre_Nm", centre * most},
                    {"upper_flank_more_by", more}}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

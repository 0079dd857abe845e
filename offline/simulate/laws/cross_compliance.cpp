// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kCrossSoftening = 0.06;  // s

// The neighbouring joint with the largest gravity torque.
int loaded_neighbour(const VectorXd& torque, int joint) {
  const double before = joint > 0 ? torque(joint - 1) : 0.0;
  const double behind = joint + 1 < torque.size() ? torque(joint + 1) : 0.0;
  return before >= behind ? joint - 1 : joint + 1;
}

}  // namespace

// A joint is deflected by the torque y of another joint, for example where a common casting twists:
//   dq = +- size ((1 - s) y + s y |y|), y = torque / largest torque
MadeLaw make_cross_compliance(const HiddenEffect& effect, const World& world) {
  constexpr double kUsual_rad = 60e-6;
  constexpr int kUsualJoint = 2;
  const VectorXd torque = largest_torque(world);
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsual_rad, "it slides")) {
    const int from = joint_number(effect, "from", world, loaded_neighbour(torque, at.joint));
    if (torque(from) <= 0.0) refuse(effect, "gravity does not turn the other joint");
    if (from == at.joint) refuse(effect, "the other joint is the same");
    const double most = torque(from), soft = kCrossSoftening * world.richness;
    const double sign = joint_random(world, "cross", at.joint).below(2) == 0 ? -1.0 : 1.0;
    out.push_back({at,
                   [=](const Moment& now) {
                     const double y = now.loads.torque(from) / most;
                     return sign * at.size * ((1.0 - soft) * y + soft * y * std::abs(y));
                   },
                   {{"torque_of", world.cell.nominal.joints[from].name},
                    {"sign", sign},
                    {"largest_torque_Nm", most},
                    {"softening", soft}},
                   {"tau" + std::to_string(from + 1)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

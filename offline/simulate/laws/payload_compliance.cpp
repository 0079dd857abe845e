// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

// Largest torque of the heaviest payload alone at the reference poses [N m].
VectorXd largest_payload_torque(const World& world) {
  VectorXd largest = VectorXd::Zero(world.arm.joints());
  for (const auto& q : reference_poses(world)) {
    const Loads loads(world.masses, world.arm.frames(q));
    for (int j = 0; j < largest.size(); ++j) {
      largest(j) = std::max(largest(j), std::abs(loads.payload_torque(j)));
    }
  }
  return largest;
}

}  // namespace

// The controller compensates the deflection of the bare arm, but not that by the payload:
//   dq = size ((1 - s) x + s x^3), x = payload torque / its largest
MadeLaw make_payload_compliance(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualPayloadYield_rad = 60e-6;
  constexpr double kProgressive = 0.08;  // s
  if (world.most_payload_kg <= 0.0) refuse(effect, "it carries nothing");
  const VectorXd torque = largest_payload_torque(world);
  const double floor = 1e-2 * torque.maxCoeff();
  std::vector<bool> loaded;
  for (int j = 0; j < torque.size(); ++j) {
    loaded.push_back(!world.arm.slides(j) && torque(j) > floor);
  }
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, loaded, loaded, kUsualPayloadYield_rad,
                                     "the payload does not turn it")) {
    const double most = torque(at.joint), cubic = kProgressive * world.richness;
    out.push_back({at,
                   [=](const Moment& now) {
                     const double x = now.loads.payload_torque(at.joint) / most;
                     return at.size * ((1.0 - cubic) * x + cubic * x * x * x);
                   },
                   {{"largest_torque_Nm", most}, {"cubic_share", cubic}}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

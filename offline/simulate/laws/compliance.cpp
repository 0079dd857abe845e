// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kJointSoftening = 0.08;  // share of the largest angle that is not linear in torque
constexpr double kUsualJointTip_m = 0.2e-3;  // of one joint, arm stretched

/// Softening spring: dq = size * ((1 - s) x + s x |x|), x = torque / largest torque.
struct Spring {
  SizedJoint at;        // size [rad] at the largest torque
  double torque = 1.0;  // largest at the reference poses [N m]
  double softening = kJointSoftening;
};

class JointCompliance : public Law {
 public:
  explicit JointCompliance(std::vector<Spring> springs) : springs_(std::move(springs)) {}

  void bend(const Moment& now, Deflection& out) const override {
    for (const auto& spring : springs_) {
      const double x = now.loads.torque(spring.at.joint) / spring.torque;
      out.dq(spring.at.joint) +=
          spring.at.size * ((1.0 - spring.softening) * x + spring.softening * x * std::abs(x));
    }
  }

  nlohmann::ordered_json truth() const override {
    auto out = nlohmann::ordered_json::array();
    for (const auto& spring : springs_) {
      out.push_back(
          {{"joint", spring.at.name},
           {"largest_urad", spring.at.size * 1e6},
           {"largest_torque_Nm", spring.torque},
           {"stiffness_Nm_per_rad", spring.torque / spring.at.size / (1.0 - spring.softening)},
           {"softening", spring.softening}});
    }
    return out;
  }

 private:
  std::vector<Spring> springs_;
};

}  // namespace

std::unique_ptr<Law> make_joint_compliance(const HiddenEffect& effect, const World& world) {
  const VectorXd torque = largest_torque(world);
  std::vector<bool> loaded;
  for (int j = 0; j < torque.size(); ++j) {
    loaded.push_back(torque(j) > 0.0);
  }
  std::vector<Spring> springs;
  for (const auto& at :
       sized_joints(effect, world, loaded, loaded, kUsualJointTip_m / world.arm.reach(),
                    "gravity does not turn it")) {
    springs.push_back({at, torque(at.joint), kJointSoftening * world.richness});
  }
  return std::make_unique<JointCompliance>(std::move(springs));
}

}  // namespace plumb::offline::sim

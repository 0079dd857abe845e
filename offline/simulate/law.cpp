// SPDX-License-Identifier: Apache-2.0
#include "simulate/law.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline::sim {
namespace {

constexpr int kReferencePoses = 500;
constexpr double kHardlyLoaded = 3e-3;  // share of weight times reach

}  // namespace

std::vector<VectorXd> reference_poses(const World& world) {
  Random random(world.seed, "reference poses");
  std::vector<VectorXd> poses;
  for (int k = 0; k < kReferencePoses; ++k) {
    VectorXd q(world.q_min.size());
    for (int j = 0; j < q.size(); ++j) q(j) = random.uniform(world.q_min(j), world.q_max(j));
    poses.push_back(q);
  }
  return poses;
}

VectorXd largest_torque(const World& world) {
  VectorXd largest = VectorXd::Zero(world.arm.joints());
  double weight = 0.0;
  for (const auto& q : reference_poses(world)) {
    const Loads loads(world.masses, world.arm.frames(q));
    weight = loads.force(0).norm();
    for (int j = 0; j < largest.size(); ++j) {
      largest(j) = std::max(largest(j), std::abs(loads.torque(j)));
    }
  }
  for (int j = 0; j < largest.size(); ++j) {
    const bool hardly = largest(j) <= kHardlyLoaded * weight * world.arm.reach();
    if (world.arm.slides(j) || hardly) largest(j) = 0.0;
  }
  return largest;
}

std::vector<SizedJoint> sized_joints(const HiddenEffect& effect, const World& world,
                                     const std::vector<bool>& possible,
                                     const std::vector<bool>& usual, double fallback,
                                     const std::string& why_not) {
  std::vector<SizedJoint> out;
  const double common = effect.size.value_or(fallback);
  const auto& rows = world.cell.nominal.joints;
  for (const auto& part : effect.joints) {
    if (!possible[part.joint]) {
      throw Failure(Exit::kUsage,
                    {Severity::kError, "E-SIM-JOINT",
                     effect.name + " is not possible on " + rows[part.joint].name + ": " + why_not,
                     std::nullopt, "name other joints, or none for the usual ones"});
    }
    out.push_back({part.joint, rows[part.joint].name, part.size.value_or(common)});
  }
  if (!effect.joints.empty()) return out;
  for (int j = 0; j < world.arm.joints(); ++j) {
    if (possible[j] && usual[j]) out.push_back({j, rows[j].name, common});
  }
  if (out.empty()) {
    throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-JOINT",
                                 effect.name + " is not possible on this arm: " + why_not,
                                 std::nullopt, "plumb simulate --help lists the effects"});
  }
  return out;
}

}  // namespace plumb::offline::sim

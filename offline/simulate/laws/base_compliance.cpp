// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualBaseTip_m = 0.15e-3;
constexpr double kBaseSoftening = 0.1;  // s

double largest_moment(const World& world) {
  double most = 0.0;
  for (const auto& q : reference_poses(world)) {
    const Loads loads(world.masses, world.arm.frames(q));
    most = std::max(most, loads.moment(0, Vector3d::Zero()).norm());
  }
  return most;
}

}  // namespace

// The floor plate turns about the base origin. It is more compliant in one direction than in the
// other, and more under load:
//   turn = size A m (1 - s + s |m|), m = moment / largest moment, A = diag(1, c) in turned axes
MadeLaw make_base_compliance(const HiddenEffect& effect, const World& world) {
  const double most = largest_moment(world);
  if (most <= 0.0) refuse(effect, "it has no weight");
  const double size = effect.size.value_or(kUsualBaseTip_m / world.arm.reach());
  Random random(world.seed, "base compliance");
  const double other = random.uniform(0.5, 0.9);
  const double bearing = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::AngleAxisd turned(bearing, Vector3d::UnitZ());
  const Eigen::Matrix3d A = turned.toRotationMatrix() * Vector3d(1.0, other, 0.3).asDiagonal() *
                            turned.toRotationMatrix().transpose();
  const double soft = kBaseSoftening * world.richness;
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const Vector3d m = now.loads.moment(0, Vector3d::Zero()) / most;
    const Vector3d turn = size * (1.0 - soft + soft * m.norm()) * (A * m);
    deflection.base = exp(Vector3d::Zero(), turn) * deflection.base;
  };
  out.truth = {{"largest_urad", size * 1e6},
               {"largest_moment_Nm", most},
               {"stiff_way_share", other},
               {"soft_axis_bearing_rad", bearing},
               {"softening", soft}};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

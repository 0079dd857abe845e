// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualRock_m = 0.15e-3;
constexpr double kEdgeShare = 0.15;  // distance of the edge from the first axis over the reach
constexpr double kCorner = 0.05;     // w
constexpr double kLeastStiffWay = 0.1, kMostStiffWay = 0.3;

}  // namespace

// The plate stands on one edge and is held down on the other side by long bolts: it turns about the
// edge as the moment about it pulls at the bolts, and hardly where it presses on the floor:
//   turn about the edge = size ((1 + c) y + (1 - c) (sqrt(y^2 + w^2) - w)) / 2
// y: moment about the edge, without its mean, over the largest one; c: 0.1 to 0.3, how much the
// plate yields the other way. The size is the largest angle.
MadeLaw make_rocking_base(const HiddenEffect& effect, const World& world) {
  const double size = effect.size.value_or(kUsualRock_m / world.arm.reach());
  Random random(world.seed, "rocking base");
  const double bearing = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double stiff_way = random.uniform(kLeastStiffWay, kMostStiffWay);
  const Vector3d edge(std::cos(bearing), std::sin(bearing), 0.0);
  const Vector3d on_edge = kEdgeShare * world.arm.reach() * Vector3d(-edge.y(), edge.x(), 0.0);
  double most = 0.0;
  for (const auto& q : reference_poses(world)) {
    const Loads loads(world.masses, world.arm.frames(q));
    most = std::max(most, std::abs(edge.dot(loads.moment(0, Vector3d::Zero()))));
  }
  if (most <= 0.0) refuse(effect, "it has no weight");
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const double y = edge.dot(now.loads.moment(0, Vector3d::Zero())) / most;
    const double turn =
        0.5 * size *
        ((1.0 + stiff_way) * y + (1.0 - stiff_way) * (std::hypot(y, kCorner) - kCorner));
    const Eigen::Translation3d to_edge(on_edge);
    deflection.base =
        to_edge * exp(Vector3d::Zero(), turn * edge) * to_edge.inverse() * deflection.base;
  };
  out.truth = {{"largest_urad", size * 1e6},
               {"largest_moment_Nm", most},
               {"edge_bearing_rad", bearing},
               {"stiff_way_share", stiff_way}};
  out.inputs = {"q1", "q2", "q3", "payload"};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

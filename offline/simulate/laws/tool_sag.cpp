// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualSag_m = 60e-6;
constexpr double kOwnShare = 0.15;   // share of the tool's own weight in the heaviest load
constexpr double kTurn_per_m = 2.0;  // [rad] for each metre that the tool sags

}  // namespace

// The tool is mounted on a compliant coupling. It sags and turns in the direction of gravity, the
// more it carries:
//   shift = size w C g_T,  turn = 2 / m size w (axis x g_T),  w = 0.15 + 0.85 payload / heaviest
MadeLaw make_tool_sag(const HiddenEffect& effect, const World& world) {
  const double size = effect.size.value_or(kUsualSag_m);
  Random random(world.seed, "tool sag");
  const Vector3d along = random.direction();
  const double stiff = random.uniform(0.2, 0.6);
  // The coupling is most compliant across one of its axes.
  const Eigen::Matrix3d C = Eigen::Matrix3d::Identity() - (1.0 - stiff) * along * along.transpose();
  const double heaviest = std::max(world.most_payload_kg, 1e-9);
  const Vector3d down = world.masses.gravity.normalized();
  const double own = kOwnShare * world.richness;
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const double weight = own + (1.0 - own) * std::min(now.visit.payload.mass_kg / heaviest, 1.0);
    const Vector3d g_T = now.frames.tool.linear().transpose() * down;
    const Vector3d turn = kTurn_per_m * size * weight * along.cross(g_T);
    deflection.tool = exp(size * weight * (C * g_T), turn) * deflection.tool;
  };
  out.truth = {{"size_um", size * 1e6},
               {"stiff_axis_T", {along.x(), along.y(), along.z()}},
               {"stiff_axis_share", stiff},
               {"own_weight_share", own}};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

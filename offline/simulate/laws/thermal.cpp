// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kWarm_K = 10.0;
constexpr double kUsualGrowth_m = 0.25e-3;
constexpr double kTiltShare = 0.15;

// Every link expands with the temperature of its zone, and the column tilts in proportion to its
// temperature above the air:
//   link_i <- link_i (1 + alpha_i T_i),  base turn = tilt (T_0 - T_air)
// The size is the expansion of the stretched arm when all of it is 10 K warmer.
ArmBending growing_links(const HiddenEffect& effect, const World& world) {
  const double reach = world.arm.reach();
  const double size = effect.size.value_or(kUsualGrowth_m);
  Random random(world.seed, "thermal growth");
  std::vector<double> alpha;
  for (int i = 0; i < world.arm.joints(); ++i) {
    alpha.push_back(size / (reach * kWarm_K) *
                    (1.0 + world.richness * random.uniform(-0.15, 0.15)));
  }
  const double bearing = random.uniform(-3.0, 3.0);
  const Vector3d tilt = world.richness * kTiltShare * size / (reach * kWarm_K) *
                        Vector3d(std::cos(bearing), std::sin(bearing), 0.0);
  ArmBending out;
  out.bend = [=, &world](const Moment& now, Deflection& deflection) {
    for (int i = 0; i < world.arm.joints(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vector3d growth =
          alpha[k] * now.visit.zone_K(i + 1) * world.arm.link_vector(i, now.visit.q);
      deflection.link[k] = Eigen::Translation3d(growth) * deflection.link[k];
    }
    const double warmer = now.visit.zone_K(0) - now.visit.room_K;
    deflection.base = exp(Vector3d::Zero(), tilt * warmer) * deflection.base;
  };
  out.truth = {{"alpha_per_K", alpha},
               {"tilt_urad_per_K", {tilt.x() * 1e6, tilt.y() * 1e6}},
               {"growth_um_at_10_K", size * 1e6}};
  return out;
}

}  // namespace

MadeLaw make_thermal_growth(const HiddenEffect& effect, const World& world) {
  ArmBending out = growing_links(effect, world);
  out.inputs = {"temp"};
  return arm_law(std::move(out));
}

// The same, for a record without any temperature: only the time says how warm the arm is.
MadeLaw make_unsensed_growth(const HiddenEffect& effect, const World& world) {
  ArmBending out = growing_links(effect, world);
  out.inputs = {"t", "order"};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

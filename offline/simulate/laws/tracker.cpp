// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualWalk_m = 40e-6;
constexpr double kSmallestRange_m = 1e-3;
constexpr double kTypicalRange_m = 4.0;

struct Errors {
  double offset_m = 0.0, scale = 0.0;
  double azimuth_rad = 0.0, elevation_rad = 0.0;  // amplitudes, two periods a turn
  double azimuth_phase = 0.0, elevation_phase = 0.0;
};

// r <- r + offset + scale r, azimuth and elevation each with an error twice a turn; the tracker
// stands upright in the origin of the measurement frame.
Vector3d error_M(const Errors& errors, const Vector3d& p) {
  const double range = std::max(p.norm(), kSmallestRange_m);
  const double level = std::max(std::hypot(p.x(), p.y()), kSmallestRange_m);
  const Vector3d out = p / range;
  const Vector3d round(-p.y() / level, p.x() / level, 0.0);
  const Vector3d up = out.cross(round);
  const double azimuth = std::atan2(p.y(), p.x()), elevation = std::atan2(p.z(), level);
  const double da = errors.azimuth_rad * std::sin(2.0 * azimuth + errors.azimuth_phase);
  const double de = errors.elevation_rad * std::sin(2.0 * elevation + errors.elevation_phase);
  return (errors.offset_m + errors.scale * range) * out + level * da * round + range * de * up;
}

}  // namespace

// The size is the radial offset. The other errors are drawn so that each moves a point at 4 m about
// as far.
MadeLaw make_tracker(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "tracker errors");
  const double size = effect.size.value_or(kUsualWalk_m);
  const double at_range = size / kTypicalRange_m;
  Errors errors;
  errors.offset_m = size;
  errors.scale = at_range * random.uniform(-1.0, 1.0);
  errors.azimuth_rad = at_range * random.uniform(0.5, 1.5);
  errors.elevation_rad = at_range * random.uniform(0.5, 1.5);
  errors.azimuth_phase = random.uniform(-std::numbers::pi, std::numbers::pi);
  errors.elevation_phase = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Isometry3d X_MB = world.X_MB, X_TG = world.X_TG;
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const Vector3d p_M = X_MB * (now.frames.tool * X_TG.translation());
    deflection.tip_B += X_MB.linear().transpose() * error_M(errors, p_M);
  };
  out.truth = {
      {"offset_um", errors.offset_m * 1e6},        {"scale_ppm", errors.scale * 1e6},
      {"azimuth_urad", errors.azimuth_rad * 1e6},  {"elevation_urad", errors.elevation_rad * 1e6},
      {"azimuth_phase_rad", errors.azimuth_phase}, {"elevation_phase_rad", errors.elevation_phase}};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

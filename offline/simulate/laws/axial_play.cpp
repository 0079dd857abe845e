// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualPlay_m = 60e-6;
constexpr double kSoftShare = 0.06;  // w: of the largest moment, within which the play is crossed
constexpr double kYieldShare = 0.2;  // b
constexpr double kRaceShare = 0.4;   // c

}  // namespace

// The bearing of the first axis has play along the axis. The column lifts and sinks with the side
// to which the arm leans, yields a little more beyond, and runs on a race that is not flat:
//   shift along the axis = size (y / sqrt(y^2 + w^2) + b y + c |y| sin(q_1 + p))
// y: moment across the first axis, about the direction of the second, over the largest one. The
// size is half the play.
MadeLaw make_axial_play(const HiddenEffect& effect, const World& world) {
  if (world.arm.joints() < 2 || world.arm.slides(0)) refuse(effect, "its first joint slides");
  const double size = effect.size.value_or(kUsualPlay_m);
  Random random(world.seed, "axial play");
  const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double beyond = world.richness * kYieldShare, race = world.richness * kRaceShare;
  const auto across = [](const Frames& frames, const Loads& loads) {
    const Vector3d axis = frames.joint[0].linear().col(2);
    const Vector3d second = frames.joint[1].linear().col(2);
    const Vector3d level = (second - axis * axis.dot(second)).normalized();
    return level.dot(loads.moment(1, frames.joint[0].translation()));
  };
  double most = 0.0;
  for (const auto& q : reference_poses(world)) {
    const Frames frames = world.arm.frames(q);
    most = std::max(most, std::abs(across(frames, Loads(world.masses, frames))));
  }
  if (most <= 0.0) refuse(effect, "nothing makes its column lean");
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const double y = across(now.frames, now.loads) / most;
    const double shift = size * (y / std::hypot(y, kSoftShare) + beyond * y +
                                 race * std::abs(y) * std::sin(now.visit.q(0) + phase));
    deflection.link[0] = Eigen::Translation3d(shift * Vector3d::UnitZ()) * deflection.link[0];
  };
  out.truth = {{"half_play_um", size * 1e6},
               {"largest_moment_Nm", most},
               {"yield_share", beyond},
               {"race_share", race},
               {"race_phase_rad", phase}};
  out.inputs = {"q2", "q3", "payload"};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

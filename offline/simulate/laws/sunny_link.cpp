// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualSun_m = 0.1e-3;
constexpr double kEarliestSun_s = 600.0, kLatestSun_s = 4200.0;
constexpr double kLeastLag_s = 900.0, kMostLag_s = 2700.0;
constexpr double kCloudShare = 0.15;  // b
constexpr double kCloud_s = 1500.0;
constexpr double kRoomShare = 0.4;   // c
constexpr double kShortLink = 0.15;  // of the reach

}  // namespace

// The sun shines on one side of a link, which bends away from it as a bow. Most of the time it is
// the same side of the link; the rest turns with the arm in the light of the window:
//   turn of its end = g(t) b, b = size (u + c l x n) / L, its shift = g(t) b x l L / 2
//   g = (1 - exp(-(t - t0) / T)) (1 + 0.15 sin(2 pi t / 25 min + p)) after t0, before it 0
// l: direction of the link, L: its length, u: across it, n: direction of the light. The size is the
// shift of a point as far behind the link as the link is long.
MadeLaw make_sunny_link(const HiddenEffect& effect, const World& world) {
  const VectorXd middle = 0.5 * (world.q_min + world.q_max);
  std::vector<bool> long_enough;
  for (int i = 0; i < world.arm.joints(); ++i)
    long_enough.push_back(world.arm.link_vector(i, middle).norm() > kShortLink * world.arm.reach());
  const auto at = sized_joints(effect, world, long_enough, long_enough, kUsualSun_m,
                               "the link behind it is too short")
                      .front();
  Random random = joint_random(world, "sunny link", at.joint);
  const double begin_s = random.uniform(kEarliestSun_s, kLatestSun_s);
  const double lag_s = random.uniform(kLeastLag_s, kMostLag_s);
  const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double bearing = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double side = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Vector3d light_B = Vector3d(std::cos(bearing), std::sin(bearing), -1.0).normalized();
  const double cloud = world.richness * kCloudShare, room = world.richness * kRoomShare;
  const auto i = static_cast<std::size_t>(at.joint);
  ArmBending out;
  out.bend = [=, &world](const Moment& now, Deflection& deflection) {
    const double t = now.visit.time_s;
    if (t <= begin_s) return;
    const double g = -std::expm1(-(t - begin_s) / lag_s) *
                     (1.0 + cloud * std::sin(2.0 * std::numbers::pi * t / kCloud_s + phase));
    const Vector3d link = world.arm.link_vector(at.joint, now.visit.q);
    const Vector3d l = link.normalized();
    const Vector3d u1 = l.unitOrthogonal(), u2 = l.cross(u1);
    const Vector3d light = now.frames.joint[i].linear().transpose() * light_B;
    const Vector3d turn = g * at.size / link.norm() *
                          (std::cos(side) * u1 + std::sin(side) * u2 + room * l.cross(light));
    const Eigen::Translation3d lever(link);
    const Eigen::Translation3d shift(Vector3d(0.5 * turn.cross(link)));
    deflection.link[i] =
        shift * lever * exp(Vector3d::Zero(), turn) * lever.inverse() * deflection.link[i];
  };
  out.truth = {{"joint", at.name},
               {"shift_um", at.size * 1e6},
               {"begin_s", begin_s},
               {"lag_s", lag_s},
               {"cloud_share", cloud},
               {"room_share", room},
               {"light_bearing_rad", bearing}};
  out.inputs = {"t", "order"};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim

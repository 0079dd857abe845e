// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kSlowest = 0.5, kFastest = 40.0;  // cycles a turn
constexpr double kFromHarmonics = 0.25;            // distance kept from 1 and 2 cycles a turn
constexpr double kSideband = 0.06;                 // b
constexpr double kLoadShare = 0.15;                // m

// Draws the cycles a turn from a log-uniform distribution. The number is hardly ever an integer.
double draw_cycles(Random& random) {
  for (;;) {
    const double k = std::exp(random.uniform(std::log(kSlowest), std::log(kFastest)));
    if (std::abs(k - 1.0) > kFromHarmonics && std::abs(k - 2.0) > kFromHarmonics) return k;
  }
}

double draw_phase(Random& random) { return random.uniform(-std::numbers::pi, std::numbers::pi); }

}  // namespace

// Tooth mesh at k cycles a joint turn, stronger under load, its strength turning with the output:
//   dq = size ((1 + m x) sin(k q + p0) + b sin((k - 1) q + p1) + b sin((k + 1) q + p2))
MadeLaw make_gear_ripple(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualRipple_rad = 100e-6;
  constexpr int kUsualJoint = 1;
  const VectorXd torque = largest_torque(world);
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualRipple_rad, "it slides")) {
    Random random = joint_random(world, "gear ripple", at.joint);
    const double k = number(effect, "cycles", draw_cycles(random));
    const double p0 = draw_phase(random), p1 = draw_phase(random), p2 = draw_phase(random);
    const double most = torque(at.joint);
    const double side = kSideband * world.richness, load = kLoadShare * world.richness;
    out.push_back({at,
                   [=](const Moment& now) {
                     const double q = now.visit.q(at.joint);
                     const double x = most > 0.0 ? now.loads.torque(at.joint) / most : 0.0;
                     const double sides =
                         std::sin((k - 1.0) * q + p1) + std::sin((k + 1.0) * q + p2);
                     return at.size * ((1.0 + load * x) * std::sin(k * q + p0) + side * sides);
                   },
                   {{"cycles_per_turn", k},
                    {"phase_rad", p0},
                    {"sideband_share", side},
                    {"load_share", most > 0.0 ? load : 0.0}},
                   {angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim

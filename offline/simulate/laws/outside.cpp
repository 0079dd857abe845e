// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

/// Joint errors that neither the library nor a few sines describe.
namespace plumb::offline::sim {
namespace {

constexpr double kUsualOutside_rad = 120e-6;
constexpr int kUsualOutside = 2;

/// One law for each joint: dq = size shape(moment, from, phase), where `from` is another joint.
template <class Shape>
MadeLaw of_another_joint(const HiddenEffect& effect, const World& world, const char* stream,
                         bool directed, const Shape& shape) {
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualOutside),
                                     kUsualOutside_rad, "it slides")) {
    Random random = joint_random(world, stream, at.joint);
    const int away = 1 + random.below(world.arm.joints() - 1);
    const int from = joint_number(effect, "from", world, (at.joint + away) % world.arm.joints());
    if (from == at.joint) refuse(effect, "the other joint is the same");
    const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double low = world.q_min(from), high = world.q_max(from);
    std::vector<std::string> inputs{angle_name(from)};
    if (directed) inputs.push_back("dir" + std::to_string(at.joint + 1));
    out.push_back({at,
                   [=](const Moment& now) {
                     const double x = (2.0 * now.visit.q(from) - low - high) / (high - low);
                     return at.size * shape(now, at.joint, from, phase, x);
                   },
                   {{"phase_rad", phase}},
                   std::move(inputs)});
  }
  return joint_law(std::move(out));
}

}  // namespace

// A joint error that is folded over at zero: dq = size |sin(q_k + phase)|
MadeLaw make_folded_sine(const HiddenEffect& effect, const World& world) {
  return of_another_joint(effect, world, "folded sine", false,
                          [](const Moment& now, int, int from, double phase, double) {
                            return std::abs(std::sin(now.visit.q(from) + phase));
                          });
}

// A joint error that grows towards one end: dq = size exp(2 (x - 1)), x from -1 to 1 over the range
MadeLaw make_growing(const HiddenEffect& effect, const World& world) {
  constexpr double kSteep = 2.0;
  return of_another_joint(
      effect, world, "growing", false,
      [](const Moment&, int, int, double, double x) { return std::exp(kSteep * (x - 1.0)); });
}

// A joint error twice a turn of another one, of which a half changes sign with the direction:
//   dq = size (sin(2 q_k + phase) (1 + sgn(d_j)) / 2)
MadeLaw make_directed_sine(const HiddenEffect& effect, const World& world) {
  return of_another_joint(effect, world, "directed sine", true,
                          [](const Moment& now, int joint, int from, double phase, double) {
                            return std::sin(2.0 * now.visit.q(from) + phase) * 0.5 *
                                   (1.0 + now.visit.direction(joint));
                          });
}

}  // namespace plumb::offline::sim

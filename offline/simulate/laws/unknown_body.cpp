// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

/// Motions of base and tool that no effect of the library describes.
namespace plumb::offline::sim {
namespace {

constexpr double kUsualShift_m = 80e-6;
constexpr double kShortest = 0.12, kLongest = 0.3;  // period as a share of the session

double periodic(double time_s, double period_s, double phase) {
  return std::sin(2.0 * std::numbers::pi * time_s / period_s + phase);
}

/// A periodic motion. Its period is the same in another session of the same arm.
class Periodic : public Law {
 public:
  Periodic(double period_s, MadeLaw law) : period_s_(period_s), law_(std::move(law)) {}
  void bend(const Moment& now, Deflection& out) const override { law_->bend(now, out); }
  nlohmann::ordered_json truth() const override { return law_->truth(); }
  std::vector<std::string> inputs() const override { return law_->inputs(); }
  void pin(HiddenEffect& effect) const override { effect.numbers["period_s"] = period_s_; }

 private:
  double period_s_;
  MadeLaw law_;
};

double draw_period(const HiddenEffect& effect, const World& world, Random& random) {
  return number(effect, "period_s", random.uniform(kShortest, kLongest) * world.session_s);
}

}  // namespace

// The heating of the hall switches on and off, and the floor moves with it:
//   base twist = (d, e) sin(2 pi t / P + p)
MadeLaw make_room_sway(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "room sway");
  const double period = draw_period(effect, world, random);
  const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double size = effect.size.value_or(kUsualShift_m);
  const Vector3d d = size * random.direction();
  const Vector3d e = 0.5 * size / world.arm.reach() * random.direction();
  const Vector3d um = d * 1e6;
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const double s = periodic(now.visit.time_s, period, phase);
    deflection.base = exp(s * d, s * e) * deflection.base;
  };
  out.truth = {{"of", "base"},
               {"period_s", period},
               {"phase_rad", phase},
               {"shift_um", {um.x(), um.y(), um.z()}}};
  out.inputs = {"t"};
  return std::make_unique<Periodic>(period, arm_law(std::move(out)));
}

// A cooling circuit switches on and off, and the reflector moves on the tool:
//   tool shift = d sin(2 pi t / P)
MadeLaw make_tool_wander(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "tool wander");
  const double period = draw_period(effect, world, random);
  const double phase = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Vector3d d = effect.size.value_or(kUsualShift_m) * random.direction();
  const Vector3d um = d * 1e6;
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const Vector3d shift = d * periodic(now.visit.time_s, period, phase);
    deflection.tool = Eigen::Translation3d(shift) * deflection.tool;
  };
  out.truth = {{"of", "tool"},
               {"period_s", period},
               {"phase_rad", phase},
               {"shift_um", {um.x(), um.y(), um.z()}}};
  out.inputs = {"t"};
  return std::make_unique<Periodic>(period, arm_law(std::move(out)));
}

}  // namespace plumb::offline::sim

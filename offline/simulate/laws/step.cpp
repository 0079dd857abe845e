// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualStep_m = 0.5e-3;
constexpr double kUsualStepAngle_rad = 200e-6;
constexpr double kEarliest = 0.25, kLatest = 0.75;  // of the session

/// The time of a bump, half way between two poses.
struct Bump {
  double at_s = 0.0;
  int row = 0;  // the first row after the bump
};

// A bump at that share of the session, or at the time that the effect states under `key`. It is
// never between two readings of one pose.
Bump bump_at(double at, const std::string& key, const HiddenEffect& effect, const World& world) {
  const auto& visits = world.visits;
  const int rows = static_cast<int>(visits.size());
  Bump bump;
  bump.at_s = number(effect, key, at * world.session_s);
  bump.row = static_cast<int>(
      std::partition_point(visits.begin(), visits.end(),
                           [&](const Visit& visit) { return visit.time_s < bump.at_s; }) -
      visits.begin());
  if (effect.numbers.count(key) > 0) return bump;
  bump.row = std::clamp(bump.row, std::min(1, rows), rows);
  while (bump.row < rows && visits[bump.row].q == visits[bump.row - 1].q) ++bump.row;
  if (bump.row == rows) refuse(effect, "it lies behind the last pose");
  bump.at_s = 0.5 * (visits[bump.row - 1].time_s + visits[bump.row].time_s);
  return bump;
}

Bump bump_of(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "bump");
  const double at = number(effect, "at", random.uniform(kEarliest, kLatest));
  return bump_at(at, "at_s", effect, world);
}

/// The change that a bump causes, at every visit after it.
class Step : public Law {
 public:
  Step(Bump bump, MadeLaw after) : bump_(bump), after_(std::move(after)) {}

  void bend(const Moment& now, Deflection& out) const override {
    if (now.visit.time_s > bump_.at_s) after_->bend(now, out);
  }

  nlohmann::ordered_json truth() const override {
    auto out = after_->truth();
    auto& part = out.is_array() ? out.at(0) : out;
    part["at_s"] = bump_.at_s;
    part["row_after"] = bump_.row;
    return out;
  }
  std::vector<std::string> inputs() const override { return {"row"}; }
  void pin(HiddenEffect& effect) const override { effect.numbers["at_s"] = bump_.at_s; }

 private:
  Bump bump_;
  MadeLaw after_;
};

/// Two bumps of one kind. Truth: {"of", "moves"}, and the numbers of each move as of a single one.
class TwoSteps : public Law {
 public:
  TwoSteps(std::array<Bump, 2> bumps, std::array<MadeLaw, 2> after)
      : at_s_{bumps[0].at_s, bumps[1].at_s},
        first_(bumps[0], std::move(after[0])),
        second_(bumps[1], std::move(after[1])) {}

  void bend(const Moment& now, Deflection& out) const override {
    first_.bend(now, out);
    second_.bend(now, out);
  }
  nlohmann::ordered_json truth() const override {
    const auto moves = nlohmann::ordered_json::array({first_.truth(), second_.truth()});
    return {{"of", moves[0]["of"]}, {"moves", moves}};
  }
  std::vector<std::string> inputs() const override { return {"row"}; }
  void pin(HiddenEffect& effect) const override {
    effect.numbers["at_s"] = at_s_[0];
    effect.numbers["at2_s"] = at_s_[1];
  }

 private:
  std::array<double, 2> at_s_;
  Step first_, second_;
};

// One bump in the first half of the session and one in the second.
std::array<Bump, 2> two_bumps(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "two bumps");
  const double early = random.uniform(0.2, 0.45), late = random.uniform(0.55, 0.8);
  return {bump_at(early, "at_s", effect, world), bump_at(late, "at2_s", effect, world)};
}

MadeLaw slipped_reflector(double size, Random random) {
  const Vector3d shift = size * random.direction();
  const Vector3d mm = shift * 1e3;
  return arm_law(
      {[=](const Moment&, Deflection& out) { out.tool = Eigen::Translation3d(shift) * out.tool; },
       {{"of", "tool"}, {"shift_mm", {mm.x(), mm.y(), mm.z()}}}});
}

// The pose of the base relative to a tracker that was pushed. Stated in the base frame.
MadeLaw pushed_tracker(double size, const World& world, Random random) {
  const Vector3d d = size * random.direction();
  const Vector3d e = 0.5 * size / world.arm.reach() * random.direction();
  const Vector3d mm = d * 1e3, urad = e * 1e6;
  return arm_law({[=](const Moment&, Deflection& out) { out.base = exp(d, e) * out.base; },
                  {{"of", "base"},
                   {"shift_mm", {mm.x(), mm.y(), mm.z()}},
                   {"rotation_urad", {urad.x(), urad.y(), urad.z()}}}});
}

}  // namespace

// The reflector slipped in its nest, so its position in the tool frame changed.
MadeLaw make_step_reflector(const HiddenEffect& effect, const World& world) {
  return std::make_unique<Step>(
      bump_of(effect, world),
      slipped_reflector(effect.size.value_or(kUsualStep_m), {world.seed, "step reflector"}));
}

// It slipped twice.
MadeLaw make_two_steps_reflector(const HiddenEffect& effect, const World& world) {
  const double size = effect.size.value_or(kUsualStep_m);
  return std::make_unique<TwoSteps>(
      two_bumps(effect, world),
      std::array{slipped_reflector(size, {world.seed, "first step of reflector"}),
                 slipped_reflector(size, {world.seed, "second step of reflector"})});
}

// Someone pushed the tracker.
MadeLaw make_step_base(const HiddenEffect& effect, const World& world) {
  return std::make_unique<Step>(
      bump_of(effect, world),
      pushed_tracker(effect.size.value_or(kUsualStep_m), world, {world.seed, "step base"}));
}

// It was pushed twice.
MadeLaw make_two_steps_base(const HiddenEffect& effect, const World& world) {
  const double size = effect.size.value_or(kUsualStep_m);
  return std::make_unique<TwoSteps>(
      two_bumps(effect, world),
      std::array{pushed_tracker(size, world, {world.seed, "first step of base"}),
                 pushed_tracker(size, world, {world.seed, "second step of base"})});
}

// An encoder slipped on its shaft, so the zero position of the joint changed.
MadeLaw make_step_encoder(const HiddenEffect& effect, const World& world) {
  constexpr int kUsualJoint = 2;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualStepAngle_rad, "it slides")) {
    out.push_back({at, [=](const Moment&) { return at.size; }, {{"of", at.name}}});
  }
  return std::make_unique<Step>(bump_of(effect, world), joint_law(std::move(out)));
}

}  // namespace plumb::offline::sim

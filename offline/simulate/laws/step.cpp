// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

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

// Chooses the time of the bump. It is never between two readings of one pose.
Bump bump_of(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "bump");
  const double at = number(effect, "at", random.uniform(kEarliest, kLatest));
  const auto& visits = world.visits;
  const int rows = static_cast<int>(visits.size());
  Bump bump;
  bump.at_s = number(effect, "at_s", at * world.session_s);
  bump.row = static_cast<int>(
      std::partition_point(visits.begin(), visits.end(),
                           [&](const Visit& visit) { return visit.time_s < bump.at_s; }) -
      visits.begin());
  if (effect.numbers.count("at_s") > 0) return bump;
  bump.row = std::clamp(bump.row, std::min(1, rows), rows);
  while (bump.row < rows && visits[bump.row].q == visits[bump.row - 1].q) ++bump.row;
  if (bump.row == rows) refuse(effect, "it lies behind the last pose");
  bump.at_s = 0.5 * (visits[bump.row - 1].time_s + visits[bump.row].time_s);
  return bump;
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

}  // namespace

// The reflector slipped in its nest, so its position in the tool frame changed.
MadeLaw make_step_reflector(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "step reflector");
  const Vector3d shift = effect.size.value_or(kUsualStep_m) * random.direction();
  const Vector3d mm = shift * 1e3;
  return std::make_unique<Step>(
      bump_of(effect, world), arm_law({[=](const Moment&, Deflection& out) {
                                         out.tool = Eigen::Translation3d(shift) * out.tool;
                                       },
                                       {{"of", "tool"}, {"shift_mm", {mm.x(), mm.y(), mm.z()}}}}));
}

// Someone pushed the tracker, so the pose of the base relative to it changed. Stated in the base
// frame.
MadeLaw make_step_base(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "step base");
  const double size = effect.size.value_or(kUsualStep_m);
  const Vector3d d = size * random.direction();
  const Vector3d e = 0.5 * size / world.arm.reach() * random.direction();
  const Vector3d mm = d * 1e3, urad = e * 1e6;
  return std::make_unique<Step>(
      bump_of(effect, world),
      arm_law({[=](const Moment&, Deflection& out) { out.base = exp(d, e) * out.base; },
               {{"of", "base"},
                {"shift_mm", {mm.x(), mm.y(), mm.z()}},
                {"rotation_urad", {urad.x(), urad.y(), urad.z()}}}}));
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

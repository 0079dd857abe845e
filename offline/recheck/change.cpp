// SPDX-License-Identifier: Apache-2.0
#include "recheck/change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "effects/registry.hpp"
#include "recheck/constants.hpp"
#include "solve/evaluation.hpp"

namespace plumb::offline::recheck {
namespace {

using Kind = Parameter::Kind;

constexpr double kNoMotion = 1e-9;  // [m/SI]: no pose shows it

template <std::size_t N>
std::vector<double> scales(const std::array<double, N>& some) {
  return {some.begin(), some.end()};
}

Eigen::VectorXd filled(std::size_t lengths, std::size_t angles) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(lengths + angles));
  out.head(static_cast<Eigen::Index>(lengths)).setConstant(kShift_m);
  out.tail(static_cast<Eigen::Index>(angles)).setConstant(kTurn_rad);
  return out;
}

bool slides(const Cell& cell, int joint) {
  return cell.nominal.joints[static_cast<std::size_t>(joint)].type == format::JointType::kPrismatic;
}

Change tool_change() {
  Change out{.part = Part::kTool, .effect = "target"};
  for (const char* name : {"target.x", "target.y", "target.z"})
    out.parameters.push_back(*placing_parameter(name));
  out.typical = filled(3, 0);
  out.scales = scales(kScalesOfPlacing);
  out.chance = kToolChanged;
  return out;
}

Change base_change() {
  Change out{.part = Part::kBase, .effect = "frame"};
  for (const char* name : {"frame.x", "frame.y", "frame.z", "frame.rx", "frame.ry", "frame.rz"})
    out.parameters.push_back(*placing_parameter(name));
  out.typical = filled(3, 3);
  out.scales = scales(kScalesOfPlacing);
  out.chance = kBaseChanged;
  return out;
}

Change joint_change(int joint, std::string_view effect) {
  Change out{.part = Part::kJoint, .joint = joint, .effect = std::string(effect)};
  out.scales = scales(kScales);
  return out;
}

Change offset_change(const Cell& cell, int joint) {
  Change out = joint_change(joint, "offset");
  const bool slide = slides(cell, joint);
  out.parameters.push_back(*robot_parameter(
      cell.nominal,
      cell.nominal.joints[static_cast<std::size_t>(joint)].name + (slide ? ".d" : ".theta")));
  out.typical = slide ? filled(1, 0) : filled(0, 1);
  out.chance = kOffset;
  return out;
}

Change bent_link(const Cell& cell, int joint) {
  Change out = joint_change(joint, "link");
  for (const char* name : {"dx", "dy", "dz", "ex", "ey", "ez"})
    out.parameters.push_back(*robot_parameter(
        cell.nominal, cell.nominal.joints[static_cast<std::size_t>(joint)].name + ".post." + name));
  out.typical = filled(3, 3);
  out.chance = kBent;
  return out;
}

std::vector<const EffectDescriptor*> effects_that_change() {
  std::vector<const EffectDescriptor*> out;
  for (const EffectDescriptor* effect : effect_descriptors())
    if (effect->later_change != nullptr) out.push_back(effect);
  return out;
}

/// The place of the effect of that name and joint in the model; -1: there is none.
int effect_at(const ArmState& state, std::string_view name, int joint) {
  const auto& all = state.arm.effects;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name &&
        std::find(all[i].joints.begin(), all[i].joints.end(), joint) != all[i].joints.end())
      return static_cast<int>(i);
  return -1;
}

Change effect_change(const ArmState& state, const Measurements& poses, int joint,
                     const EffectDescriptor& effect) {
  Change out = joint_change(joint, effect.name);
  const int place = effect_at(state, effect.name, joint);
  if (place < 0) return out;
  const auto& joints = state.arm.effects[static_cast<std::size_t>(place)].joints;
  const auto count = state.arm.effects[static_cast<std::size_t>(place)].parameters.size();
  const auto among = std::find(joints.begin(), joints.end(), joint) - joints.begin();
  const auto each = count / joints.size();
  for (std::size_t k = 0; k < each; ++k) {
    const int component = static_cast<int>(static_cast<std::size_t>(among) * each + k);
    out.parameters.push_back(
        {Kind::kEffect, place, component, effect_parameter_name(state.arm, place, component)});
  }
  // A usual change of an effect moves the point by a tenth of a millimetre, or by half of the
  // effect if that is more.
  const Eigen::MatrixXd motion = derivatives(poses, state, out.parameters);
  out.typical = kEffect_m * std::sqrt(static_cast<double>(poses.size())) *
                motion.colwise().norm().transpose().cwiseMax(1e-12).cwiseInverse();
  for (std::size_t k = 0; k < each; ++k) {
    double& typical = out.typical(static_cast<Eigen::Index>(k));
    typical = std::max(typical, kEffectShare * std::abs(value_of(state, out.parameters[k])));
  }
  if (motion.cwiseAbs().maxCoeff() < kNoMotion) out.parameters.clear();
  out.scales = scales(kScalesOfEffect);
  out.chance = effect.later_change->chance;
  return out;
}

}  // namespace

const char* name_of(Part part) {
  switch (part) {
    case Part::kTool:
      return "tool";
    case Part::kBase:
      return "base";
    case Part::kJoint:
      return "joint";
    case Part::kReading:
      return "reading";
    case Part::kOther:
      break;
  }
  return "other";
}

bool same(const Change& a, const Change& b) {
  return a.part == b.part && a.joint == b.joint && a.effect == b.effect && a.row == b.row;
}

std::string words_of(const Change& change, const Cell& cell) {
  if (change.part == Part::kTool) return "the tool or the reflector";
  if (change.part == Part::kBase) return "the base or the tracker";
  if (change.part == Part::kReading) return fmt::format("reading {} alone", change.row + 1);
  if (change.part == Part::kOther) return "something else";
  const std::string& joint = cell.nominal.joints[static_cast<std::size_t>(change.joint)].name;
  if (change.effect == "offset") return fmt::format("the encoder offset of {}", joint);
  if (const EffectDescriptor* effect = find_descriptor(change.effect))
    return fmt::format(fmt::runtime(effect->later_change->words), joint);
  return fmt::format("the link behind {}", joint);
}

ArmState with_room_for_changes(const Cell& cell, const Measurements& of_arm,
                               const Measurements& rows, const ArmState& state) {
  ArmState out = state;
  const bool arrives = rows.context.has_direction() && of_arm.context.has_direction();
  for (int j = 0; j < cell.joints(); ++j)
    for (const EffectDescriptor* effect : effects_that_change()) {
      if (effect_at(out, effect->name, j) >= 0) continue;
      if ((effect->law->needs & kNeedsDirection) != 0 && !arrives) continue;
      if (effect->at_slide == nullptr && slides(cell, j)) continue;
      EffectEntry entry;
      entry.name = effect->name;
      entry.joints = {j};
      out.arm.effects.push_back(bind_effect(cell, of_arm, entry));
    }
  return out;
}

std::vector<Change> possible_changes(const Cell& cell, const ArmState& extended,
                                     const Measurements& poses, int readings) {
  std::vector<Change> joints;
  for (int j = 0; j < cell.joints(); ++j) {
    joints.push_back(offset_change(cell, j));
    // A change of the last joint's link is a change of the tool.
    if (j + 1 < cell.joints()) joints.push_back(bent_link(cell, j));
    for (const EffectDescriptor* effect : effects_that_change())
      joints.push_back(effect_change(extended, poses, j, *effect));
  }
  std::erase_if(joints, [](const Change& change) { return change.parameters.empty(); });
  double sum = 0.0;
  for (const auto& change : joints) sum += change.chance;
  for (auto& change : joints) change.chance *= kJointsChanged / sum;
  std::vector<Change> out{tool_change(), base_change()};
  out.insert(out.end(), joints.begin(), joints.end());
  if (readings < 4)  // too few to say that one of them is wrong
    for (auto& change : out) change.chance /= 1.0 - kReadingsWrong;
  return out;
}

Solution linearised(const Measurements& rows, const ArmState& state,
                    const std::vector<Parameter>& parameters) {
  FitData data;
  data.measured = &rows;
  for (int i = 0; i < rows.size(); ++i) data.rows.push_back(i);
  data.sigma_m = Rows3::Ones(rows.size(), 3);
  return evaluate(data, state, parameters);
}

Eigen::MatrixXd derivatives(const Measurements& rows, const ArmState& state,
                            const std::vector<Parameter>& parameters) {
  return linearised(rows, state, parameters).jacobian;
}

Change odd_reading(int row, int readings, double sigma_m) {
  Change out{.part = Part::kReading, .row = row};
  out.typical = Eigen::VectorXd::Constant(3, sigma_m);
  out.scales = scales(kScalesOfReading);
  out.chance = kReadingsWrong / readings;
  return out;
}

}  // namespace plumb::offline::recheck

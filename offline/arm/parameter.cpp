// SPDX-License-Identifier: Apache-2.0
#include "arm/parameter.hpp"

#include <algorithm>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "arm/neighbouring_axes.hpp"
#include "cell/link_frame.hpp"
#include "cell/setups.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

using Kind = Parameter::Kind;

/// Shortest reach [m], so that an arm without link lengths has one. Chosen.
constexpr double kLeastReach_m = 0.1;

const char* const kTwistNames[] = {"dx", "dy", "dz", "ex", "ey", "ez"};
const char* const kPoseNames[] = {"x", "y", "z", "rx", "ry", "rz"};

void add_dh_candidates(const Cell& cell, std::vector<Parameter>& out) {
  const auto& chain = cell.nominal;
  const int n = cell.joints();
  std::vector<bool> beta(n, false), hold_d(n, false);
  for (int i = 0; i + 1 < n; ++i) {
    const int row = link_row(chain, i);
    if (!cell.mechanics[i].parallel_next && !near_parallel(chain, i)) continue;
    beta[row] = true;
    // A sliding joint keeps its d, which is the offset of its own travel.
    if (chain.joints[i].type == format::JointType::kRevolute) hold_d[i] = true;
  }
  for (int i = 0; i < n; ++i) {
    const auto add = [&](Kind kind, const char* name) {
      out.push_back({kind, i, 0, chain.joints[i].name + "." + name});
    };
    add(Kind::kTheta, "theta");
    if (!hold_d[i]) add(Kind::kD, "d");
    add(Kind::kA, "a");
    add(Kind::kAlpha, "alpha");
    if (beta[i]) add(Kind::kBeta, "beta");
  }
}

void add_twist_candidates(const Cell& cell, std::vector<Parameter>& out) {
  for (int i = 0; i < cell.joints(); ++i)
    for (int k = 0; k < 6; ++k)
      out.push_back(
          {Kind::kLinkTwist, i, k, cell.nominal.joints[i].name + ".post." + kTwistNames[k]});
}

/// What follows "frame" or "target" in a name: ".", with several set-ups "[day 2].".
std::string of_setup(const MeasurementSettings& m, int setup) {
  const std::string name = setup_name(m, setup);
  return name.empty() ? "." : "[" + name + "].";
}

/// "frame.x", with several set-ups "frame[day 2].x", of artefacts "plane[table].z". A shared frame
/// or target belongs to the first set-up that has it.
void add_placing_candidates(const MeasurementSettings& m, Orientation orientation,
                            std::vector<Parameter>& out) {
  for (int s = 0; s < setup_count(m); ++s) {
    const Setup rule = setup_rule(m, s);
    const std::string of = of_setup(m, s);
    const auto add = [&](Kind kind, int component, const char* pose_name) {
      const char* what = kind == Kind::kFrame ? "frame" : "target";
      out.push_back({kind, 0, component, what + of + pose_name, s});
    };
    if (rule.is_artefact())
      for (Parameter& p : artefact_parameters(m, s)) out.push_back(std::move(p));
    else if (rule.fit_frame && frame_root(m, s) == s)
      for (int k = 0; k < 6; ++k) add(Kind::kFrame, k, kPoseNames[k]);
    if (!rule.fit_target || target_root(m, s) != s) continue;
    for (int k = 0; k < 3; ++k) add(Kind::kTarget, k, kPoseNames[k]);
    if (orientation == Orientation::kUsed)
      for (int k = 0; k < 3; ++k) add(Kind::kTargetRotation, k, kPoseNames[k + 3]);
  }
}

}  // namespace

bool Parameter::is_length() const {
  switch (kind) {
    case Kind::kD:
    case Kind::kA:
    case Kind::kPoint:
    case Kind::kArtefactLength:
    case Kind::kTarget:
      return true;
    case Kind::kPlane:
      return component == 0;
    case Kind::kLinkTwist:
    case Kind::kFrame:
      return component < 3;
    default:
      return false;
  }
}

bool Parameter::of_robot() const {
  return !of_base() && kind != Kind::kTarget && kind != Kind::kTargetRotation;
}

double reach(const format::Chain& chain) {
  return std::max(kLeastReach_m, stretched_length(chain));
}

std::string frame_prefix(const MeasurementSettings& settings, int setup) {
  return "frame" + of_setup(settings, setup);
}

std::string artefact_prefix(const MeasurementSettings& settings, int setup) {
  return descriptor_of(setup_rule(settings, setup).reads).noun + of_setup(settings, setup);
}

std::vector<Parameter> artefact_parameters(const MeasurementSettings& settings, int setup) {
  const Setup& rule = settings.setups[static_cast<std::size_t>(setup)];
  const std::string prefix = artefact_prefix(settings, setup);
  const bool plane = is_of_plane(rule.reads);
  std::vector<Parameter> out;
  for (int k = 0; k < 3; ++k)
    out.push_back(
        {plane ? Kind::kPlane : Kind::kPoint, 0, k, prefix + kPoseNames[plane ? k + 2 : k], setup});
  if (rule.fit_length) out.push_back({Kind::kArtefactLength, 0, 0, prefix + "length", setup});
  return out;
}

std::vector<Parameter> candidate_parameters(const Cell& cell, Orientation orientation) {
  std::vector<Parameter> out;
  add_placing_candidates(cell.measurement, orientation, out);
  if (cell.effects.empty() || !is_geometry(cell.effects.front().name)) return out;
  if (cell.fit.model == FitSettings::Model::kDh)
    add_dh_candidates(cell, out);
  else
    add_twist_candidates(cell, out);
  std::erase_if(out, [&](const Parameter& p) {
    return std::find(cell.fit.fixed.begin(), cell.fit.fixed.end(), p.name) != cell.fit.fixed.end();
  });
  return out;
}

std::optional<Parameter> robot_parameter(const format::Chain& chain, const std::string& name) {
  static const std::pair<const char*, Kind> kDh[] = {{"theta", Kind::kTheta},
                                                     {"d", Kind::kD},
                                                     {"a", Kind::kA},
                                                     {"alpha", Kind::kAlpha},
                                                     {"beta", Kind::kBeta}};
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const std::string prefix = chain.joints[i].name + ".";
    if (!name.starts_with(prefix)) continue;
    const std::string rest = name.substr(prefix.size());
    for (const auto& [text, kind] : kDh)
      if (rest == text) return Parameter{kind, static_cast<int>(i), 0, name};
    for (int k = 0; k < 6; ++k)
      if (rest == std::string("post.") + kTwistNames[k])
        return Parameter{Kind::kLinkTwist, static_cast<int>(i), k, name};
  }
  return std::nullopt;
}

std::optional<Parameter> placing_parameter(const std::string& name) {
  for (int k = 0; k < 6; ++k)
    if (name == std::string("frame.") + kPoseNames[k]) return Parameter{Kind::kFrame, 0, k, name};
  for (int k = 0; k < 3; ++k)
    if (name == std::string("target.") + kPoseNames[k]) return Parameter{Kind::kTarget, 0, k, name};
  return std::nullopt;
}

std::vector<Parameter> effect_parameters(const format::Model& arm) {
  std::vector<Parameter> out;
  for (std::size_t e = 0; e < arm.effects.size(); ++e)
    for (std::size_t k = 0; k < arm.effects[e].parameters.size(); ++k) {
      const int effect = static_cast<int>(e), parameter = static_cast<int>(k);
      out.push_back(
          {Kind::kEffect, effect, parameter, effect_parameter_name(arm, effect, parameter)});
    }
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "semantic_check.hpp"

#include <algorithm>
#include <cmath>

#include "tree_check.hpp"

namespace plumb::format::internal {
namespace {

constexpr double kMaxLength_m = 100.0;
constexpr double kMaxAngle_rad = 4.0 * 3.14159265358979323846;
constexpr double kMaxTwist = 1.0;       // [m] or [rad]
constexpr double kUnitSlack = 1e-9;     // of a quaternion's length
constexpr std::size_t kMaxText = 256;   // bytes of a name
constexpr std::size_t kMaxInputs = 64;  // files a model was made from
constexpr std::size_t kHashDigits = 64;

using Finding = std::optional<std::string>;

std::string number(double x) { return std::to_string(x); }

bool within(double x, double limit) { return std::isfinite(x) && std::abs(x) <= limit; }

Finding check_text(const std::string& text, const std::string& what) {
  if (text.size() > kMaxText)
    return what + " is longer than " + std::to_string(kMaxText) + " bytes";
  const bool control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (control) return what + " holds control characters";
  return std::nullopt;
}

Finding check_pose(const Pose& pose, const std::string& what) {
  for (double x : pose.p)
    if (!within(x, kMaxLength_m)) return what + ": translation " + number(x) + " m is out of range";
  double norm2 = 0.0;
  for (double x : pose.q) norm2 += x * x;
  if (!(std::abs(std::sqrt(norm2) - 1.0) <= kUnitSlack))
    return what + ": the quaternion is not of unit length";
  return std::nullopt;
}

Finding check_twist(const Twist& twist, const std::string& what) {
  for (const auto& part : {twist.d, twist.e})
    for (double x : part)
      if (!within(x, kMaxTwist)) return what + ": " + number(x) + " is out of range";
  return std::nullopt;
}

Finding check_joint(const JointRow& row, const std::string& what) {
  if (row.name.empty()) return what + " has no name";
  if (auto f = check_text(row.name, what + ".name")) return f;
  for (double x : {row.alpha, row.theta, row.beta})
    if (!within(x, kMaxAngle_rad)) return what + ": angle " + number(x) + " rad is out of range";
  for (double x : {row.a, row.d})
    if (!within(x, kMaxLength_m)) return what + ": length " + number(x) + " m is out of range";
  if (!(row.scale >= 0.5 && row.scale <= 2.0))
    return what + ": scale " + number(row.scale) + " is not between 0.5 and 2";
  if (!within(row.offset, kMaxLength_m)) return what + ": the offset is out of range";
  if (!within(row.q_min, 1e4) || !within(row.q_max, 1e4) || !(row.q_min < row.q_max))
    return what + ": the limits " + number(row.q_min) + " … " + number(row.q_max) + " are no range";
  if (auto f = check_twist(row.pre, what + ".pre")) return f;
  return check_twist(row.post, what + ".post");
}

Finding check_chain(const Chain& chain, const std::string& what) {
  if (chain.convention != Convention::kStandard && chain.convention != Convention::kModified)
    return what + ": unknown DH convention";
  const std::size_t n = chain.joints.size();
  if (n < 1 || n > kMaxJoints)
    return what + ": " + std::to_string(n) + " joints, not 1 … " + std::to_string(kMaxJoints);
  for (std::size_t i = 0; i < n; ++i)
    if (auto f = check_joint(chain.joints[i], what + ".joints[" + std::to_string(i + 1) + "]"))
      return f;
  if (auto f = check_pose(chain.base, what + ".base")) return f;
  if (auto f = check_twist(chain.base_twist, what + ".base_twist")) return f;
  if (auto f = check_pose(chain.tool, what + ".tool")) return f;
  return check_twist(chain.tool_twist, what + ".tool_twist");
}

Finding check_same_arm(const Model& m) {
  const auto &a = m.nominal.joints, &b = m.calibrated.joints;
  if (a.size() != b.size()) return "nominal and calibrated chain differ in the number of joints";
  if (m.nominal.convention != m.calibrated.convention)
    return "nominal and calibrated chain differ in the DH convention";
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].name != b[i].name || a[i].type != b[i].type)
      return "joint " + std::to_string(i + 1) + " differs between nominal and calibrated chain";
  return std::nullopt;
}

bool is_effect_name(const std::string& name) {
  return !name.empty() && name.size() <= kMaxText &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

Finding check_effect(const Effect& effect, std::size_t joints) {
  const std::string what = "effect '" + effect.name + "'";
  if (!is_effect_name(effect.name)) return "an effect's name is not of a-z, 0-9 and _";
  if (effect.version == 0) return what + " has version 0";
  if (effect.joints.size() > kMaxJoints) return what + " names too many joints";
  for (auto joint : effect.joints)
    if (joint >= joints) return what + " names joint " + std::to_string(joint + 1);
  if (effect.parameters.size() > kMaxEffectParameters) return what + " has too many parameters";
  for (double x : effect.parameters)
    if (!std::isfinite(x)) return what + " has a parameter that is not finite";
  if (effect.context.size() > kMaxJoints) return what + " needs too much context";
  for (const auto& need : effect.context) {
    if (need.input > ContextInput::kTime) return what + " needs an unknown input";
    if (!std::isfinite(need.fallback)) return what + " has a fallback that is not finite";
    if (auto f = check_text(need.name, what + " context")) return f;
  }
  return std::nullopt;
}

Finding check_domain(const Model& m) {
  const auto& d = m.domain;
  const bool trees =
      std::any_of(m.trees.begin(), m.trees.end(), [](const Tree& t) { return !t.bounds.empty(); });
  if (d.q_min.size() != d.q_max.size()) return "the trained domain has limits of different count";
  if (d.q_min.empty())
    return trees ? Finding("the model has a tree but no trained domain") : std::nullopt;
  if (d.q_min.size() != m.nominal.joints.size())
    return "the trained domain has " + std::to_string(d.q_min.size()) + " joints";
  for (std::size_t i = 0; i < d.q_min.size(); ++i)
    if (!within(d.q_min[i], 1e4) || !within(d.q_max[i], 1e4) || !(d.q_max[i] - d.q_min[i] >= 1e-9))
      return "the trained domain of joint " + std::to_string(i + 1) + " is no range";
  if (!(d.fade > 1e-6 && d.fade <= 1.0)) return "the fade of the trained domain is not in 0 … 1";
  return std::nullopt;
}

Finding check_guard(const GuardLimits& g) {
  struct Limit {
    const char* name;
    double value, low, high;
  };
  const Limit limits[] = {{"max_correction_m", g.max_correction_m, 1e-9, 0.1},
                          {"max_rotation_rad", g.max_rotation_rad, 1e-9, 0.5},
                          {"slew_m_per_s", g.slew_m_per_s, 1e-9, 10.0},
                          {"slew_rad_per_s", g.slew_rad_per_s, 1e-9, 10.0},
                          {"ramp_s", g.ramp_s, 0.0, 3600.0},
                          {"cycle_s", g.cycle_s, 1e-5, 10.0},
                          {"length_scale_m", g.length_scale_m, 1e-3, kMaxLength_m},
                          {"min_singular_value", g.min_singular_value, 1e-6, 1.0},
                          {"max_seed_distance", g.max_seed_distance, 1e-6, 3.2}};
  if (g.corrects > Corrects::kPose) return "the guard corrects neither position nor pose";
  for (const auto& l : limits)
    if (!(l.value >= l.low && l.value <= l.high))
      return std::string("guard limit ") + l.name + " = " + number(l.value) + " is out of range";
  return std::nullopt;
}

bool is_hash(const std::string& text) {
  return text.size() == kHashDigits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Finding check_provenance(const Provenance& p) {
  for (const auto* text : {&p.tool_version, &p.created, &p.run})
    if (auto f = check_text(*text, "provenance")) return f;
  if (p.inputs.size() > kMaxInputs) return "provenance names too many input files";
  for (const auto& input : p.inputs) {
    if (auto f = check_text(input.name, "provenance input")) return f;
    if (!is_hash(input.sha256))
      return "the SHA-256 of input '" + input.name + "' is not 64 hex digits";
  }
  const auto& h = p.held_out;
  for (double x : {h.mean_m, h.rms_m, h.p95_m, h.max_m, p.noise_floor_m})
    if (!(x >= 0.0 && x <= kMaxLength_m)) return "a held-out figure is out of range";
  constexpr double kRounding = 1.0 + 1e-9;
  if (h.mean_m > h.rms_m * kRounding || h.rms_m > h.max_m * kRounding || h.p95_m > h.max_m)
    return "the held-out figures contradict each other";
  const std::size_t k = p.parameter_names.size();
  if (k > kMaxParameters) return "there are too many fitted parameters";
  if (!p.covariance.empty() && p.covariance.size() != k * (k + 1) / 2)
    return "the covariance does not fit the number of parameters";
  for (const auto& name : p.parameter_names)
    if (auto f = check_text(name, "a parameter's name")) return f;
  for (float x : p.covariance)
    if (!std::isfinite(x)) return "the covariance is not finite";
  for (std::size_t i = 0, at = 0; i < k && !p.covariance.empty(); at += ++i + 1)
    if (p.covariance[at] < 0.0F) return "the covariance has a negative variance";
  return std::nullopt;
}

}  // namespace

Finding unsoundness(const Model& m) {
  for (const auto* text : {&m.cell_name, &m.robot_name, &m.serial})
    if (auto f = check_text(*text, "a name")) return f;
  for (double g : m.gravity)
    if (!within(g, 100.0)) return "gravity is out of range";
  if (auto f = check_chain(m.nominal, "nominal")) return f;
  if (auto f = check_chain(m.calibrated, "calibrated")) return f;
  if (auto f = check_same_arm(m)) return f;
  if (m.effects.size() > kMaxEffects) return "there are too many effects";
  for (const auto& effect : m.effects)
    if (auto f = check_effect(effect, m.nominal.joints.size())) return f;
  if (auto f = check_domain(m)) return f;
  for (std::size_t axis = 0; axis < m.trees.size(); ++axis)
    if (auto f = unsound_tree(m.trees[axis], m.nominal.joints.size()))
      return "tree " + std::to_string(axis + 1) + ": " + *f;
  if (auto f = check_guard(m.guard)) return f;
  return check_provenance(m.provenance);
}

}  // namespace plumb::format::internal

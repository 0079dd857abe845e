// SPDX-License-Identifier: Apache-2.0
#include "semantic_check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "formula_check.hpp"
#include "plumb/format/context_ranges.hpp"
#include "plumb/format/coupling.hpp"
#include "plumb/format/formula.hpp"
#include "provenance_check.hpp"
#include "text_check.hpp"
#include "tree_check.hpp"

namespace plumb::format::internal {
namespace {

// Larger numbers belong to no arm; they come from a wrong unit or a damaged file.
constexpr double kMaxLength_m = 100.0;
constexpr double kMaxAngle_rad = 4.0 * 3.14159265358979323846;  // two turns
constexpr double kMaxMass_kg = 1e5;
constexpr double kMaxTwist = 1.0;          // [m] or [rad]
constexpr double kMaxJointPosition = 1e4;  // [rad] or [m]: many turns
constexpr double kMaxContext = 1e6;        // [kg], [m], [N], [N m], [degC]
constexpr double kMinSpan = 1e-9;          // of the trained domain, [rad] or [m]; it is a divisor
constexpr double kMinFade = 1e-6;          // as a share of that span; it is a divisor
constexpr double kUnitSlack = 1e-9;        // tolerance for the length of a quaternion

using Finding = std::optional<std::string>;

/// The shortest decimal number that is read back as x, in any locale.
std::string number(double x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

bool within(double x, double limit) { return std::isfinite(x) && std::abs(x) <= limit; }

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
  if (auto f = unprintable(row.name, what + ".name")) return f;
  if (row.type != JointType::kRevolute && row.type != JointType::kPrismatic)
    return what + ": unknown type of joint";
  for (double x : {row.alpha, row.theta, row.beta})
    if (!within(x, kMaxAngle_rad)) return what + ": angle " + number(x) + " rad is out of range";
  for (double x : {row.a, row.d})
    if (!within(x, kMaxLength_m)) return what + ": length " + number(x) + " m is out of range";
  if (!(row.scale >= 0.5 && row.scale <= 2.0))
    return what + ": scale " + number(row.scale) + " is not between 0.5 and 2";
  if (!within(row.offset, kMaxLength_m)) return what + ": the offset is out of range";
  if (!within(row.q_min, kMaxJointPosition) || !within(row.q_max, kMaxJointPosition) ||
      !(row.q_min < row.q_max))
    return what + ": the limits " + number(row.q_min) + " … " + number(row.q_max) + " are no range";
  if (auto f = check_twist(row.pre, what + ".pre")) return f;
  return check_twist(row.post, what + ".post");
}

Finding check_coupling(const Chain& chain, const std::string& what) {
  const auto& all = chain.coupling;
  if (all.size() > kMaxCouplings) return what + " has too many couplings of joints";
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto same = [&](const auto& b) { return b.joint == one->joint && b.by == one->by; };
    if (std::max(one->joint, one->by) >= chain.joints.size())
      return what + " couples a joint that it does not have";
    if (chain.joints[one->joint].type != chain.joints[one->by].type)
      return what + " couples a joint that turns with one that slides";
    if (one->ratio == 0.0 || !within(one->ratio, kMaxCouplingRatio))
      return what + ": the ratio " + number(one->ratio) + " of two joints is out of range";
    if (std::any_of(all.begin(), one, same)) return what + " couples two joints twice";
  }
  auto ordered = all;
  if (!put_in_order(ordered)) return what + " couples joints that depend on each other";
  return std::nullopt;
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
  if (auto f = check_coupling(chain, what + ".coupling")) return f;
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
  if (m.nominal.coupling != m.calibrated.coupling)
    return "nominal and calibrated chain differ in the coupling of their joints";
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].name != b[i].name || a[i].type != b[i].type)
      return "joint " + std::to_string(i + 1) + " differs between nominal and calibrated chain";
  return std::nullopt;
}

bool is_effect_name(const std::string& name) {
  return !name.empty() && !unprintable(name, "") &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// Effects of a measurement are fitted so that they do not distort the rest. The cycle can never
/// know their inputs (the row, the position of the tracker), so a model file must not name them.
Finding check_measurement(const Effect& effect) {
  constexpr const char* kOfMeasurement[] = {"drift", "settling_lag", "step", "tracker"};
  const bool named = std::any_of(std::begin(kOfMeasurement), std::end(kOfMeasurement),
                                 [&](const char* name) { return effect.name == name; });
  if (!named && !reads_measurement(effect.formula)) return std::nullopt;
  return "effect '" + effect.name +
         "' belongs to a measurement, which a model file must not contain";
}

Finding check_effect(const Effect& effect, std::size_t joints) {
  const std::string what = "effect '" + effect.name + "'";
  if (!is_effect_name(effect.name)) return "an effect's name is not of a-z, 0-9 and _";
  if (auto f = check_measurement(effect)) return f;
  if (effect.version == 0) return what + " has version 0";
  if (effect.joints.size() > kMaxJoints) return what + " names too many joints";
  for (auto joint : effect.joints)
    if (joint >= joints)
      return what + " names joint " + std::to_string(joint + 1) + " of " + std::to_string(joints);
  if (effect.parameters.size() > kMaxEffectParameters)
    return what + " has too many parameters: " + std::to_string(effect.parameters.size()) +
           ", at most " + std::to_string(kMaxEffectParameters);
  for (double x : effect.parameters)
    if (!std::isfinite(x)) return what + " has a parameter that is not finite";
  if (effect.constants.size() > kMaxEffectConstants) return what + " has too many constants";
  for (double x : effect.constants)
    if (!std::isfinite(x)) return what + " has a constant that is not finite";
  if (effect.context.size() > kMaxJoints) return what + " needs too much context";
  for (const auto& need : effect.context) {
    if (need.input > ContextInput::kTravel) return what + " needs an unknown input";
    if (!std::isfinite(need.fallback)) return what + " has a fallback that is not finite";
    if (auto f = unprintable(need.name, what + " context")) return f;
  }
  return unsound_formula(effect, joints);
}

Finding check_mechanics(const Mechanics& m, std::size_t joints) {
  const auto sound = [](double mass, const std::array<double, 3>& com) {
    return mass >= 0.0 && mass <= kMaxMass_kg && within(com[0], kMaxLength_m) &&
           within(com[1], kMaxLength_m) && within(com[2], kMaxLength_m);
  };
  if (!m.links.empty() && m.links.size() != joints)
    return "there are masses of " + std::to_string(m.links.size()) + " links";
  for (std::size_t i = 0; i < m.links.size(); ++i)
    if (!sound(m.links[i].mass_kg, m.links[i].com_m))
      return "the mass of link " + std::to_string(i + 1) + " is out of range";
  if (!sound(m.payload_kg, m.payload_com_m)) return "the payload is out of range";
  return std::nullopt;
}

bool is_named(const ContextRange& r) {
  if (r.input == ContextInput::kTemperature) return !r.name.empty();
  return r.input == ContextInput::kPayload &&
         std::find(kLoadNames.begin(), kLoadNames.end(), r.name) != kLoadNames.end();
}

Finding check_ranges(const std::vector<ContextRange>& ranges) {
  if (ranges.size() > kMaxContextRanges)
    return "the trained domain has " + std::to_string(ranges.size()) + " ranges of context";
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const ContextRange& r = ranges[i];
    if (auto f = unprintable(r.name, "the trained domain's range of an input")) return f;
    if (!is_named(r)) return "the trained domain has a range of an unknown input '" + r.name + "'";
    if (!within(r.low, kMaxContext) || !within(r.high, kMaxContext) || !(r.low <= r.high))
      return "the trained domain of input '" + r.name + "' is no range";
    for (std::size_t b = 0; b < i; ++b)
      if (ranges[b].input == r.input && ranges[b].name == r.name)
        return "the trained domain has two ranges of input '" + r.name + "'";
  }
  return std::nullopt;
}

Finding check_domain(const Model& m) {
  const auto& d = m.domain;
  const bool trees =
      std::any_of(m.trees.begin(), m.trees.end(), [](const Tree& t) { return !t.bounds.empty(); });
  if (!(d.fade > kMinFade && d.fade <= 1.0))
    return "the fade of the trained domain is " + number(d.fade) + ", not in 0 … 1";
  if (auto f = check_ranges(d.context)) return f;
  if (d.q_min.size() != d.q_max.size()) return "the trained domain has limits of different count";
  if (d.q_min.empty())
    return trees ? Finding("the model has a tree but no trained domain") : std::nullopt;
  if (d.q_min.size() != m.nominal.joints.size())
    return "the trained domain has " + std::to_string(d.q_min.size()) + " joints";
  for (std::size_t i = 0; i < d.q_min.size(); ++i)
    if (!within(d.q_min[i], kMaxJointPosition) || !within(d.q_max[i], kMaxJointPosition) ||
        !(d.q_max[i] - d.q_min[i] >= kMinSpan))
      return "the trained domain of joint " + std::to_string(i + 1) + " is no range";
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

}  // namespace

Finding unsoundness(const Model& m) {
  for (const auto* text : {&m.cell_name, &m.robot_name, &m.serial})
    if (auto f = unprintable(*text, "the name of cell or robot, or the serial number,")) return f;
  for (double g : m.gravity)
    if (!within(g, 100.0)) return "gravity is out of range";
  if (auto f = check_chain(m.nominal, "nominal")) return f;
  if (auto f = check_chain(m.calibrated, "calibrated")) return f;
  if (auto f = check_same_arm(m)) return f;
  if (m.effects.size() > kMaxEffects) return "there are too many effects";
  for (const auto& effect : m.effects)
    if (auto f = check_effect(effect, m.nominal.joints.size())) return f;
  if (auto f = check_mechanics(m.mechanics, m.nominal.joints.size())) return f;
  if (auto f = check_domain(m)) return f;
  for (std::size_t axis = 0; axis < m.trees.size(); ++axis)
    if (auto f = unsound_tree(m.trees[axis], m.nominal.joints.size()))
      return "tree " + std::to_string(axis + 1) + ": " + *f;
  if (auto f = check_guard(m.guard)) return f;
  return unsound_provenance(m.provenance);
}

}  // namespace plumb::format::internal

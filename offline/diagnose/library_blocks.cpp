// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "diagnose/block.hpp"
#include "diagnose/few_digits.hpp"
#include "fit/dual.hpp"
#include "fit/effect_binding.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

constexpr double kTypicalMotion_m = 0.1e-3;  // RMS, of parameters whose size the arm decides
constexpr std::array kTorqueShares = {0.03, 0.1, 0.3};
constexpr std::array kTransitions_deg = {0.05, 0.2, 0.6, 2.0};
constexpr std::array kSpringRatios = {0.25, 0.5, 0.8};
constexpr std::array kSettlingShares = {0.1, 0.3};  // of the session
constexpr double kNoMotion_m = 1e-12;               // per unit of a parameter, in SI

/// Laws that only turn the joint they are listed for.
const std::set<std::string, std::less<>> kJointLaws = {
    "joint_compliance",  "joint_compliance_soft", "gravity_free",         "gear_harmonics",
    "gear_ripple",       "encoder_scale",         "encoder_eccentricity", "reversal",
    "backlash_load",     "settling_lag",          "cross_compliance",     "payload_compliance",
    "wrench_compliance", "gravity_compensator"};

/// Another law in disguise, a net too wide, or found by a scan of their own.
const std::set<std::string, std::less<>> kNotSearched = {"encoder_eccentricity", "joint_table",
                                                         "step", "gear_ripple", "formula"};

struct Bound {
  const Stage& stage;
  format::Effect effect;
  int law = -1;
  EffectShape shape;

  Bound(const Stage& s, const EffectEntry& entry)
      : stage(s),
        effect(bind_effect(*s.cell, *s.measured, entry)),
        law(find_effect_law(entry.name)) {
    shape = {.arm_joints = s.joints(),
             .joints = effect.joints,
             .constants = effect.constants,
             .formula = effect.formula.code.empty() ? nullptr : &effect.formula};
    for (const auto& need : effect.context)
      if (need.input == format::ContextInput::kTemperature)
        shape.sensors.add(static_cast<std::uint8_t>(
            std::find(s.sensors.begin(), s.sensors.end(), need.name) - s.sensors.begin()));
  }
  Eigen::Index count() const { return static_cast<Eigen::Index>(effect.parameters.size()); }

  Situation at(Eigen::Index i) const {
    return {.q = stage.q(i),
            .chain = stage.chain,
            .frames = stage.frames[i],
            .loads = stage.loads[i],
            .context = stage.context[i]};
  }
};

/// Calls visit(pose, first parameter, motion) with derivatives by up to eight parameters.
template <class Visit>
void differentiate(const Bound& bound, const Visit& visit) {
  for (Eigen::Index first = 0; first < bound.count(); first += Dual::kLanes) {
    std::vector<Dual> theta(bound.effect.parameters.begin(), bound.effect.parameters.end());
    const Eigen::Index lanes = std::min<Eigen::Index>(Dual::kLanes, bound.count() - first);
    for (Eigen::Index l = 0; l < lanes; ++l) theta[first + l].d(l) = 1.0;
    for (Eigen::Index i = 0; i < bound.stage.poses(); ++i) {
      Motion<Dual> motion;
      apply_effect<Dual>(bound.law, theta, bound.shape, bound.at(i), motion);
      for (Eigen::Index l = 0; l < lanes; ++l) visit(i, first + l, l, motion);
    }
  }
}

void joint_columns(const Bound& bound, Block& out) {
  const int joint = bound.effect.joints.front();
  out.joint = joint;
  out.columns.resize(bound.stage.poses(), bound.count());
  differentiate(bound, [&](Eigen::Index i, Eigen::Index c, Eigen::Index lane, const auto& motion) {
    out.columns(i, c) = motion.dq[joint].d(lane);
  });
}

void motion_columns(const Bound& bound, Block& out) {
  const Stage& s = bound.stage;
  out.columns.setZero(s.poses() * s.axes, bound.count());
  differentiate(bound, [&](Eigen::Index i, Eigen::Index c, Eigen::Index lane, const auto& motion) {
    Vector3 d(motion.shift_B(0).d(lane), motion.shift_B(1).d(lane), motion.shift_B(2).d(lane));
    const Vector3 e(motion.turn_B(0).d(lane), motion.turn_B(1).d(lane), motion.turn_B(2).d(lane));
    d = s.X_MB.R * (d + cross<double>(e, s.arm_B[i]));
    Eigen::Index line = i * s.axes;
    for (int k = 0; k < 3; ++k)
      if (s.measured->has_axis[k]) {
        double sum = d(k) / s.sigma[line];
        for (int j = 0; j < s.joints(); ++j) sum += s.joint[j](line) * motion.dq[j].d(lane);
        out.columns(line++, c) = sum;
      }
  });
}

/// RMS motion of the measured point [m] per unit of a column.
double motion_of(const Stage& s, const Block& block, Eigen::Index c) {
  double sum = 0.0;
  if (block.joint < 0)
    sum = block.columns.col(c).squaredNorm();
  else
    sum = (block.columns.col(c).array().square() * s.joint_square[block.joint].array()).sum();
  return std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(1, s.poses()))) * s.sigma_m;
}

double stated_typical(const Stage& s, const Bound& bound, const EffectParameter& info,
                      Eigen::Index c) {
  const auto& name = bound.effect.name;
  if (name == "joint_compliance" || name == "joint_compliance_soft") {
    const auto joints = static_cast<Eigen::Index>(bound.effect.joints.size());
    const int joint = bound.effect.joints[c * joints / bound.count()];
    const auto& stiffness = s.cell->mechanics[joint].stiffness_Nm_per_rad;
    if (stiffness && info.typical == 0.0) return 1.0 / *stiffness;
  }
  if (name == "link_flexure") {
    const auto& link = s.cell->mechanics[bound.effect.joints[c / 2]];
    const auto& yields = c % 2 == 0 ? link.EI_Nm2 : link.GJ_Nm2;
    if (yields) return 1.0 / *yields;
  }
  return info.typical;
}

/// Divides by typical sizes; columns that move nothing are left out.
void scale(const Bound& bound, Block& out) {
  const Stage& s = bound.stage;
  format::Model model;
  model.effects = {bound.effect};
  std::vector<Eigen::Index> moving;
  std::vector<double> typical;
  for (Eigen::Index c = 0; c < bound.count(); ++c) {
    const double motion = motion_of(s, out, c);
    if (!(motion > kNoMotion_m)) continue;
    const EffectParameter& info = effect_parameter(model, 0, static_cast<int>(c));
    double size = stated_typical(s, bound, info, c);
    if (size == 0.0) size = kTypicalMotion_m / motion;
    moving.push_back(c);
    typical.push_back(size);
    out.positive.push_back(info.low == 0.0 && info.high > 0.0);
  }
  Eigen::MatrixXd kept(out.columns.rows(), static_cast<Eigen::Index>(moving.size()));
  for (std::size_t i = 0; i < moving.size(); ++i)
    kept.col(static_cast<Eigen::Index>(i)) = out.columns.col(moving[i]) * typical[i];
  out.columns = std::move(kept);
  out.typical =
      Eigen::Map<Eigen::VectorXd>(typical.data(), static_cast<Eigen::Index>(typical.size()));
  out.members.assign(moving.begin(), moving.end());
}

EffectEntry entry_of(const std::string& name, std::vector<int> joints = {}) {
  return {.name = name, .joints = std::move(joints), .options = {}, .place = {}};
}

std::vector<int> turning(const Stage& s) {
  std::vector<int> out;
  for (int j = 0; j < s.joints(); ++j)
    if (s.chain.revolute(j)) out.push_back(j);
  return out;
}

double session_of(const Stage& s) {
  double low = 1e300, high = -1e300;
  for (const auto& c : s.context) {
    const double now = c.time_s == c.time_s ? c.time_s : c.order;
    low = std::min(low, now);
    high = std::max(high, now);
  }
  return high - low;
}

/// The non-linear numbers of a law that are tried.
std::vector<EffectEntry> on_grid(const Stage& s, const EffectEntry& entry) {
  std::vector<EffectEntry> out;
  const auto with = [&](const char* key, EffectEntry::Value value) {
    out.push_back(entry);
    out.back().options[key] = std::move(value);
  };
  if (entry.name == "joint_compliance_soft" || entry.name == "backlash_load") {
    const double torque = largest_torque(s, entry.joints.front());
    for (double share : kTorqueShares)
      if (torque > 0.0) with("torque_Nm", three_digits(share * torque));
  } else if (entry.name == "reversal") {
    for (double transition : kTransitions_deg) with("transition_deg", transition);
  } else if (entry.name == "gravity_compensator") {
    for (double length : kSpringRatios)
      for (double anchor : kSpringRatios) {
        with("length_ratio", length);
        out.back().options["anchor_ratio"] = anchor;
      }
  } else if (entry.name == "drift") {
    out.push_back(entry);
    for (double share : kSettlingShares) with("settling_s", three_digits(share * session_of(s)));
  } else if (entry.name == "thermal_growth") {
    for (const auto& sensor : s.sensors) with("sensor", sensor);
  } else {
    out.push_back(entry);
  }
  return out;
}

std::vector<EffectEntry> entries_of(const Stage& s, int law) {
  const EffectInfo& info = effect_info(law);
  const std::string name(info.name);
  std::vector<EffectEntry> out;
  if (name == "cross_compliance") {
    for (int i : turning(s))
      for (int j : turning(s))
        if (i != j && largest_torque(s, j) > 0.0) out.push_back(entry_of(name, {i, j}));
  } else if (name == "gravity_compensator") {
    if (s.joints() > 1 && s.chain.revolute(1)) out.push_back(entry_of(name, {1}));
  } else if (info.per_joint && name != "thermal_growth") {
    for (int j : turning(s)) out.push_back(entry_of(name, {j}));
  } else {
    out.push_back(entry_of(name));
  }
  return out;
}

bool listed(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

double largest_torque(const Stage& s, int joint) {
  double out = 0.0;
  for (std::size_t i = 0; i < s.loads.size(); ++i)
    out = std::max(out, std::abs(s.loads[i].torque(joint, s.chain, s.frames[i])));
  return out;
}

Block library_block(const Stage& stage, const EffectEntry& entry) {
  const Bound bound(stage, entry);
  Block out;
  out.entry = entry;
  const bool one_joint = entry.joints.size() < 2 || entry.name == "cross_compliance";
  if (kJointLaws.contains(entry.name) && one_joint)
    joint_columns(bound, out);
  else
    motion_columns(bound, out);
  scale(bound, out);
  return out;
}

void visit_library(const Stage& stage, const std::vector<std::string>& not_testable,
                   const BlockVisitor& visit) {
  for (int law = 0; law < kEffectLaws; ++law) {
    const EffectInfo& info = effect_info(law);
    if (kNotSearched.contains(info.name) || listed(not_testable, info.name)) continue;
    for (const auto& entry : entries_of(stage, law))
      for (const auto& tried : on_grid(stage, entry)) {
        const Block block = library_block(stage, tried);
        if (block.columns.cols() > 0) visit(block);
      }
  }
}

}  // namespace plumb::offline

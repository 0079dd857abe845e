// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <span>

#include "arm/dual.hpp"
#include "arm/effect_binding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/few_digits.hpp"
#include "diagnose/regressor.hpp"
#include "effects/fitted_laws.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr int kJointsWithWrist = 6;  // an arm of fewer has no wrist of three
/// Where orientations are measured, a rotation counts as the motion of a point so far away [m].
constexpr double kBeside_m = 0.1;
constexpr double kNoMotion_m = 1e-12;  // per unit of a parameter, in SI

struct Bound {
  const WhitenedFit& whitened;
  const std::vector<Loads>& loads;
  format::Effect effect;
  int law = -1;
  EffectShape shape;

  Bound(const WhitenedFit& s, const EffectEntry& entry) : Bound(s, entry, s.loads) {}
  Bound(const WhitenedFit& s, const EffectEntry& entry, const std::vector<Loads>& on_arm)
      : whitened(s),
        loads(on_arm),
        effect(bind_effect(*s.cell, *s.measured, entry)),
        law(find_fitted_law(entry.name)) {
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
    return {.q = whitened.q(i),
            .chain = whitened.chain,
            .frames = whitened.frames[i],
            .loads = loads[i],
            .context = whitened.context[i].known};
  }
};

/// Calls visit(pose, first parameter, motion) with derivatives by up to eight parameters.
template <class Visit>
void differentiate(const Bound& bound, const Visit& visit) {
  for (Eigen::Index first = 0; first < bound.count(); first += Dual::kLanes) {
    std::vector<Dual> theta(bound.effect.parameters.begin(), bound.effect.parameters.end());
    const Eigen::Index lanes = std::min<Eigen::Index>(Dual::kLanes, bound.count() - first);
    for (Eigen::Index l = 0; l < lanes; ++l) theta[first + l].d(l) = 1.0;
    for (Eigen::Index i = 0; i < bound.whitened.poses(); ++i) {
      Motion<Dual> motion;
      apply_fitted_law<Dual>(bound.law, theta, bound.shape, bound.at(i), bound.whitened.context[i],
                             motion);
      for (Eigen::Index l = 0; l < lanes; ++l) visit(i, first + l, l, motion);
    }
  }
}

void joint_columns(const Bound& bound, Regressor& out) {
  const int joint = bound.effect.joints.front();
  out.joint = joint;
  out.columns.resize(bound.whitened.poses(), bound.count());
  differentiate(bound, [&](Eigen::Index i, Eigen::Index c, Eigen::Index lane, const auto& motion) {
    out.columns(i, c) = motion.dq[joint].d(lane);
  });
}

void motion_columns(const Bound& bound, Regressor& out) {
  const WhitenedFit& s = bound.whitened;
  out.columns.setZero(s.table.lines(), bound.count());
  differentiate(bound, [&](Eigen::Index i, Eigen::Index c, Eigen::Index lane, const auto& motion) {
    Vector3 d(motion.shift_B(0).d(lane), motion.shift_B(1).d(lane), motion.shift_B(2).d(lane));
    const Vector3 e(motion.turn_B(0).d(lane), motion.turn_B(1).d(lane), motion.turn_B(2).d(lane));
    const Matrix3& R_MB = s.X_MB[i].R;
    d = R_MB * (d + cross<double>(e, s.arm_B[i]));
    auto lines = out.columns.col(c).segment(s.table.begin(i), s.table.count(i));
    s.reading[i].project(s.target_M(i), d, R_MB * e, lines);
    whiten(s, i, lines);
    for (int j = 0; j < s.joints(); ++j)
      lines += s.joint[j].segment(s.table.begin(i), s.table.count(i)) * motion.dq[j].d(lane);
  });
}

/// RMS motion [m] of the measured point and, by its rotation, of a point beside it: per unit of a
/// column. A rotation that hardly moves the measured point moves others.
double motion_beside(const WhitenedFit& s, const Regressor& regressor, Eigen::Index c) {
  Eigen::VectorXd moved = motion(s, regressor, Eigen::VectorXd::Unit(regressor.columns.cols(), c));
  double sum = 0.0;
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    auto lines = moved.segment(s.table.begin(i), s.table.count(i));
    unwhiten(s, i, lines);
    const Reading& reading = s.reading[i];
    sum += lines.head(reading.point_lines()).squaredNorm() +
           std::pow(kBeside_m, 2) * lines.tail(reading.turn_lines()).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(1, s.poses())));
}

/// RMS motion of the measured point [m] per unit of a column.
double motion_of(const WhitenedFit& s, const Regressor& regressor, Eigen::Index c) {
  if (s.turns()) return motion_beside(s, regressor, c);
  double sum = 0.0;
  if (regressor.joint < 0)
    sum = regressor.columns.col(c).squaredNorm();
  else
    sum =
        (regressor.columns.col(c).array().square() * s.joint_square[regressor.joint].array()).sum();
  return std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(1, s.poses()))) * s.sigma_m;
}

double stated_typical(const WhitenedFit& s, const Bound& bound, const EffectParameter& info,
                      Eigen::Index c) {
  const StatedSize stated = descriptor_of(bound.effect.name).stated_size;
  if (stated == StatedSize::kJointStiffness) {
    const auto joints = static_cast<Eigen::Index>(bound.effect.joints.size());
    const int joint = bound.effect.joints[c * joints / bound.count()];
    const auto& stiffness = s.cell->mechanics[joint].stiffness_Nm_per_rad;
    if (stiffness && info.typical == 0.0) return 1.0 / *stiffness;
  }
  if (stated == StatedSize::kLinkStiffness) {
    const auto& link = s.cell->mechanics[bound.effect.joints[c / 2]];
    const auto& yields = c % 2 == 0 ? link.EI_Nm2 : link.GJ_Nm2;
    if (yields) return 1.0 / *yields;
  }
  return info.typical;
}

/// Divides by typical sizes; columns that move nothing are left out.
void scale(const Bound& bound, Regressor& out) {
  const WhitenedFit& s = bound.whitened;
  format::Model model;
  model.calibrated = s.cell->nominal;
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

EffectEntry entry_of(const EffectDescriptor& effect, std::vector<int> joints = {}) {
  return {
      .name = std::string(effect.name), .joints = std::move(joints), .options = {}, .place = {}};
}

/// The revolute joints, or the prismatic ones.
std::vector<int> joints_of(const WhitenedFit& s, bool turning) {
  std::vector<int> out;
  for (int j = 0; j < s.joints(); ++j)
    if (s.chain.revolute(j) == turning) out.push_back(j);
  return out;
}

std::vector<int> turning(const WhitenedFit& s) { return joints_of(s, true); }

/// Ordered pairs of neighbours whose second joint turns: its drive may move the first. Pairs within
/// the last three of six joints or more are left to the law of a wrist, which is one of all three.
std::vector<EffectEntry> neighbours(const WhitenedFit& s, const EffectDescriptor& effect) {
  std::vector<EffectEntry> out;
  const int wrist = s.joints() >= kJointsWithWrist ? s.joints() - 3 : s.joints();
  for (int j = 0; j + 1 < s.joints(); ++j) {
    if (s.chain.revolute(j) && j < wrist) out.push_back(entry_of(effect, {j + 1, j}));
    if (s.chain.revolute(j + 1) && j < wrist) out.push_back(entry_of(effect, {j, j + 1}));
  }
  return out;
}

/// The grids of option values to try: those of the law, or its own ones for a sliding joint.
std::span<const GridAxis> grid_of(const WhitenedFit& s, const EffectEntry& entry) {
  const EffectDescriptor& effect = descriptor_of(entry.name);
  return effect.at_slide != nullptr && all_slide(*s.cell, entry) ? effect.at_slide->grid
                                                                 : effect.grid;
}

double session_of(const WhitenedFit& s) {
  double low = 1e300, high = -1e300;
  for (const auto& c : s.context) {
    const double now = c.known.time_s == c.known.time_s ? c.known.time_s : c.order;
    low = std::min(low, now);
    high = std::max(high, now);
  }
  return high - low;
}

std::vector<EffectEntry::Value> shares_of(double whole, std::span<const double> shares) {
  std::vector<EffectEntry::Value> out;
  for (const double share : shares) out.emplace_back(three_digits(share * whole));
  return out;
}

/// Pitches between two shares of a travel [m], half a period over the travel from one to the next.
std::vector<EffectEntry::Value> pitches_mm(double travel, double longest, double shortest) {
  std::vector<EffectEntry::Value> out;
  if (!(travel > kLeastTravel_m)) return out;
  for (double periods = 1.0 / longest; periods <= 1.0 / shortest; periods += 0.5)
    out.emplace_back(five_digits(1e3 * travel / periods));
  return out;
}

/// The values of one option that are tried.
std::vector<EffectEntry::Value> values_of(const WhitenedFit& s, const EffectEntry& entry,
                                          const GridAxis& axis) {
  switch (axis.kind) {
    case GridAxis::Values::kSensors:
      return std::vector<EffectEntry::Value>(s.sensors.begin(), s.sensors.end());
    case GridAxis::Values::kOfSession:
      return shares_of(session_of(s), axis.values);
    case GridAxis::Values::kPitches:
      return pitches_mm(travel_of(s, entry.joints.front()), axis.values[0], axis.values[1]);
    case GridAxis::Values::kOfLargestTorque: {
      const double torque = largest_torque(s, entry.joints.front());
      if (!(torque > 0.0)) return {};
      return shares_of(torque, axis.values);
    }
    default:
      return std::vector<EffectEntry::Value>(axis.values.begin(), axis.values.end());
  }
}

/// The entry with every combination of the values of its options that are tried.
std::vector<EffectEntry> on_grid(const WhitenedFit& s, const EffectEntry& entry,
                                 std::span<const GridAxis> grid) {
  std::vector<EffectEntry> out{entry};
  for (const GridAxis& axis : grid) {
    const auto values = values_of(s, entry, axis);
    std::vector<EffectEntry> combined;
    for (const EffectEntry& one : out) {
      if (axis.also_without) combined.push_back(one);
      for (const auto& value : values) {
        combined.push_back(one);
        set_option(combined.back(), axis.key, value);
      }
    }
    out = std::move(combined);
  }
  return out;
}

/// One entry for each joint, or pair of joints, for which the law is tried.
std::vector<EffectEntry> entries_of(const WhitenedFit& s, const EffectDescriptor& effect) {
  std::vector<EffectEntry> out;
  switch (effect.candidate_joints) {
    case CandidateJoints::kLoadedPairs:
      for (int i : turning(s))
        for (int j : turning(s))
          if (i != j && largest_torque(s, j) > 0.0) out.push_back(entry_of(effect, {i, j}));
      break;
    case CandidateJoints::kSecond:
      if (s.joints() > 1 && s.chain.revolute(1)) out.push_back(entry_of(effect, {1}));
      break;
    case CandidateJoints::kEach:
      for (int j = 0; j < s.joints(); ++j)
        if (s.chain.revolute(j) || effect.at_slide != nullptr) out.push_back(entry_of(effect, {j}));
      break;
    case CandidateJoints::kSliding:
      for (int j : joints_of(s, false)) out.push_back(entry_of(effect, {j}));
      break;
    case CandidateJoints::kNeighbours:
      out = neighbours(s, effect);
      break;
    case CandidateJoints::kNone:
      out.push_back(entry_of(effect));
  }
  return out;
}

bool listed(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

double largest_torque(const WhitenedFit& s, int joint) {
  double out = 0.0;
  for (std::size_t i = 0; i < s.loads.size(); ++i)
    out = std::max(out, std::abs(s.loads[i].torque(joint, s.chain, s.frames[i])));
  return out;
}

const Refinement* refinement_of(const Cell& cell, const EffectEntry& entry) {
  const EffectDescriptor& effect = descriptor_of(entry.name);
  return effect.at_slide != nullptr && all_slide(cell, entry) ? effect.at_slide->refinement
                                                              : effect.refinement;
}

Regressor library_regressor(const WhitenedFit& whitened, const EffectEntry& entry) {
  const Bound bound(whitened, entry);
  Regressor out;
  out.entry = entry;
  const EffectDescriptor& effect = descriptor_of(entry.name);
  const bool one_joint = entry.joints.size() < 2 || effect.joints == JointList::kOrderedPair;
  if (effect.turns_listed_joint_only && one_joint)
    joint_columns(bound, out);
  else
    motion_columns(bound, out);
  scale(bound, out);
  return out;
}

Eigen::MatrixXd motions_under(const WhitenedFit& whitened, const EffectEntry& entry,
                              const std::vector<Loads>& loads) {
  Regressor out;
  motion_columns(Bound(whitened, entry, loads), out);
  return std::move(out.columns);
}

void visit_library(const WhitenedFit& whitened, const std::vector<std::string>& not_testable,
                   const RegressorVisitor& visit) {
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (effect->search != Search::kGrid || listed(not_testable, effect->name)) continue;
    for (const auto& entry : entries_of(whitened, *effect))
      for (const auto& tried : on_grid(whitened, entry, grid_of(whitened, entry))) {
        const Regressor regressor = library_regressor(whitened, tried);
        if (regressor.columns.cols() > 0) visit(regressor);
      }
  }
}

}  // namespace plumb::offline

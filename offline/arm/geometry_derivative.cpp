// SPDX-License-Identifier: Apache-2.0
#include "arm/geometry_derivative.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/dual.hpp"
#include "arm/effect_binding.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

using Kind = Parameter::Kind;

constexpr int kSlotFrame = -2;   // acts on X_MB, seen from the base
constexpr int kSlotTarget = -3;  // acts on X_TG, seen from the tool
constexpr int kSlotEffect = -4;  // has its own columns

Vector3 axis(int k) { return Vector3::Unit(k); }

/// Left Jacobian of SO(3) at e: d/de of exp(e) v = -[exp(e) v]x J(e).
Matrix3 left_jacobian(const Vector3& e) {
  const double angle = e.norm();
  Matrix3 k;
  k << 0, -e(2), e(1), e(2), 0, -e(0), -e(1), e(0), 0;
  if (angle < 1e-6) return Matrix3::Identity() + 0.5 * k + k * k / 6.0;
  return Matrix3::Identity() + (1 - std::cos(angle)) / (angle * angle) * k +
         (angle - std::sin(angle)) / (angle * angle * angle) * k * k;
}

}  // namespace

GeometryDerivative::GeometryDerivative(const ArmState& start,
                                       const std::vector<Parameter>& parameters,
                                       const Eigen::VectorXd& change)
    : state_(moved(start, parameters, change)),
      chain_(state_.arm.calibrated),
      effects_(state_.arm),
      wave_of_(state_.arm.effects.size(), -1),
      sensors_(temperature_names(state_.arm)) {
  twists_.reserve(parameters.size());
  std::vector<Matrix3> frame_turns, plane_turns, target_turns;  // by set-up, from the start on
  for (int k = 0; k < start.setups(); ++k) {
    X_MB_.push_back(from_pose(state_.frame(k)));
    X_TG_.push_back(from_pose(state_.target(k)));
    frame_turns.push_back(from_pose(start.frame(k)).R *
                          left_jacobian(gathered(parameters, change, Kind::kFrame, 3, k)));
    plane_turns.push_back(left_jacobian(gathered(parameters, change, Kind::kPlane, 1, k)));
    target_turns.push_back(
        from_pose({{}, start.target(k).q}).R *
        left_jacobian(gathered(parameters, change, Kind::kTargetRotation, 0, k)));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    if (p.kind == Kind::kFrame) {
      // In the measurement frame. The turn acts about the origin of the base.
      const bool shift = p.component < 3;
      const Matrix3 R_MB0 = from_pose(start.frame(p.setup)).R;
      twists_.push_back(
          {kSlotFrame, shift ? Vector3(R_MB0 * axis(p.component)) : Vector3::Zero(),
           shift ? Vector3::Zero() : Vector3(frame_turns[p.setup] * axis(p.component - 3)),
           p.setup});
    } else if (p.kind == Kind::kPoint) {
      twists_.push_back({kSlotFrame, -axis(p.component), Vector3::Zero(), p.setup});
    } else if (p.kind == Kind::kPlane) {
      const bool shift = p.component == 0;
      twists_.push_back(
          {kSlotFrame, shift ? axis(2) : Vector3::Zero(),
           shift ? Vector3::Zero() : Vector3(plane_turns[p.setup] * axis(p.component - 1)),
           p.setup});
    } else if (p.kind == Kind::kArtefactLength) {
      twists_.push_back({kSlotFrame, Vector3::Zero(), Vector3::Zero(), p.setup});
    } else if (p.kind == Kind::kTarget) {
      twists_.push_back({kSlotTarget, axis(p.component), Vector3::Zero(), p.setup});
    } else if (p.kind == Kind::kTargetRotation) {
      twists_.push_back({kSlotTarget, Vector3::Zero(),
                         Vector3(target_turns[p.setup] * axis(p.component)), p.setup});
    } else if (p.of_effect()) {
      add_column(p, static_cast<Eigen::Index>(i));
      twists_.push_back({kSlotEffect, Vector3::Zero(), Vector3::Zero()});
    } else {
      twists_.push_back(slot_twist(p));
    }
  }
}

/// The elementary motion of a parameter as a constant twist in the frame after a joint.
GeometryDerivative::SlotTwist GeometryDerivative::slot_twist(const Parameter& p) const {
  const auto& chain = state_.arm.calibrated;
  const auto& row = chain.joints[p.joint];
  const bool standard = chain.convention == format::Convention::kStandard;
  const auto behind_motion = [&](const format::JointRow& r) {
    return r.type == format::JointType::kRevolute ? translation(0, 0, r.d) : Transformd{};
  };
  Transformd X;  // from the slot's frame to where the elementary motion acts
  int slot = p.joint;
  switch (p.kind) {
    case Kind::kTheta:
      return {slot, Vector3::Zero(), axis(2)};
    case Kind::kD:
      return {slot, axis(2), Vector3::Zero()};
    case Kind::kLinkTwist:
      X = behind_motion(row);
      break;
    default:
      if (standard) {
        X = behind_motion(row) * exp(row.post);
      } else if (p.joint > 0) {
        slot = p.joint - 1;
        X = behind_motion(chain.joints[slot]) * exp(chain.joints[slot].post);
      } else {
        slot = -1;
        X = from_pose(chain.base) * exp(chain.base_twist);
      }
  }
  Vector3 d = Vector3::Zero(), e = Vector3::Zero();
  switch (p.kind) {
    case Kind::kLinkTwist:
      (p.component < 3 ? d : e)(p.component % 3) = 1.0;
      break;
    case Kind::kA:
      d = axis(0);
      break;
    case Kind::kAlpha:
      X = X * translation(row.a, 0, 0);
      e = axis(0);
      break;
    default:
      X = X * translation(row.a, 0, 0) * rot_x(row.alpha);
      e = axis(1);
  }
  const Vector3 e_slot = X.R * e;
  return {slot, X.R * d + cross<double>(X.p, e_slot), e_slot};
}

void GeometryDerivative::add_column(const Parameter& p, Eigen::Index column) {
  const format::Effect& effect = state_.arm.effects[static_cast<std::size_t>(p.joint)];
  if (is_series(effect.name)) {
    add_series_column(p, column);
    return;
  }
  if (!is_wave(effect.name) || effect.joints.size() != 1) {
    effect_columns_.push_back({p.joint, p.component, column});
    return;
  }
  int& place = wave_of_[static_cast<std::size_t>(p.joint)];
  if (place < 0) {
    place = static_cast<int>(waves_.size());
    waves_.push_back({.effect = p.joint, .joint = effect.joints.front()});
  }
  waves_[static_cast<std::size_t>(place)].column[static_cast<std::size_t>(p.component)] = column;
}

void GeometryDerivative::add_series_column(const Parameter& p, Eigen::Index column) {
  const format::Effect& effect = state_.arm.effects[static_cast<std::size_t>(p.joint)];
  const std::size_t each = effect.parameters.size() / effect.joints.size();
  const auto place = static_cast<std::size_t>(p.component);
  const int joint = effect.joints[place / each];
  if (series_.empty() || series_.back().effect != p.joint || series_.back().joint != joint)
    series_.push_back(
        {.effect = p.joint, .joint = joint, .column = std::vector<Eigen::Index>(each, -1)});
  series_.back().column[place % each] = column;
}

/// One pose without and with the motion by the effects.
struct GeometryDerivative::MovedPose {
  ChainFrames rigid;
  ChainFrames frames;  // with the joint motions of the effects, without shift and turn of the tip
  FittedEffects::Surroundings around;
  Motion<double> motion;
  Matrix3 turn = Matrix3::Identity();  // rotation of the tip by the effects
  int undefined = -1;                  // the first effect without a value
  std::array<std::array<double, 2>, format::kMaxEffects> wave_slope;  // of the joint, by wave
};

/// Adds the motion by a wave, and keeps its derivatives.
void GeometryDerivative::apply_wave(std::size_t w, std::span<const double> q,
                                    MovedPose& out) const {
  using Number = DualOf<2>;
  const Wave& wave = waves_[w];
  const auto& values = state_.arm.effects[static_cast<std::size_t>(wave.effect)].parameters;
  std::array<Number, 2> theta{values[0], values[1]};
  theta[0].d(0) = theta[1].d(1) = 1.0;
  Motion<Number> motion;
  effects_.apply_one<Number>(wave.effect, theta, q, chain_, out.rigid, out.around, motion);
  const Number& moved = motion.dq[static_cast<std::size_t>(wave.joint)];
  out.motion.dq[static_cast<std::size_t>(wave.joint)] += moved.v;
  out.wave_slope[w] = {moved.d(0), moved.d(1)};
}

void GeometryDerivative::bend(std::span<const double> q, const MeasuredContext& context,
                              MovedPose& out) const {
  chain_.frames(q, out.rigid);
  if (effects_.empty()) {
    out.frames = out.rigid;
    return;
  }
  effects_.survey(out.rigid, context, out.around);
  for (int i = 0; i < effects_.size(); ++i) {
    if (const int wave = wave_of_[static_cast<std::size_t>(i)]; wave >= 0) {
      apply_wave(static_cast<std::size_t>(wave), q, out);
      continue;
    }
    effects_.apply_one<double>(i, state_.arm.effects[i].parameters, q, chain_, out.rigid,
                               out.around, out.motion);
    if (out.motion.undefined && out.undefined < 0) out.undefined = i;
  }
  std::array<double, kMaxJoints> there{};
  for (std::size_t j = 0; j < q.size(); ++j) there[j] = q[j] + out.motion.dq[j];
  chain_.frames(std::span<const double>(there).first(q.size()), out.frames);
  out.turn = turned(out.motion.turn_B).R;
}

/// arm_B: from the tip to the reflector, before the effects turn the tip.
void GeometryDerivative::effect_columns(std::span<const double> q, const MovedPose& bent,
                                        const Vector3& arm_B, const Matrix3& R_MB,
                                        Point& out) const {
  const Matrix3 turn_rate = left_jacobian(bent.motion.turn_B);
  const Vector3 turned_arm = bent.turn * arm_B;
  using Motion6 = Eigen::Matrix<double, 6, 1>;
  std::array<Motion6, kMaxJoints> by_joint;  // motion of the reflector per unit of a joint
  for (int j = 0; j < chain_.joints(); ++j) {
    const Vector3 axis = bent.frames.joint[j].R.col(2) * chain_.scale(j);
    if (!chain_.revolute(j)) {
      by_joint[j] << R_MB * axis, Vector3::Zero();
      continue;
    }
    const Vector3 d = cross<double>(axis, bent.frames.tip.p - bent.frames.joint[j].p) +
                      bent.turn * cross<double>(axis, arm_B);
    by_joint[j] << R_MB * d, R_MB * (bent.turn * axis);
  }
  for (std::size_t w = 0; w < waves_.size(); ++w)
    for (std::size_t k = 0; k < 2; ++k)
      if (waves_[w].column[k] >= 0)
        out.columns.col(waves_[w].column[k]) = by_joint[waves_[w].joint] * bent.wave_slope[w][k];
  std::array<double, 2 * format::kMaxSeriesWaves> slopes;
  for (const auto& series : series_) {
    const auto count = series.column.size();
    effects::JointSeries::slopes(portable::sin_cos(q[static_cast<std::size_t>(series.joint)]),
                                 std::span(slopes).first(count));
    for (std::size_t k = 0; k < count; ++k)
      if (series.column[k] >= 0)
        out.columns.col(series.column[k]) = by_joint[series.joint] * slopes[k];
  }
  std::vector<Dual> theta;
  // Eight parameters at a time, of one or several effects: the motions of effects add up, and so do
  // their derivatives.
  for (std::size_t first = 0; first < effect_columns_.size();) {
    const std::size_t last = std::min(first + Dual::kLanes, effect_columns_.size());
    Motion<Dual> motion;
    for (std::size_t i = first; i < last;) {
      const int effect = effect_columns_[i].effect;
      const auto& values = state_.arm.effects[effect].parameters;
      theta.assign(values.begin(), values.end());
      for (; i < last && effect_columns_[i].effect == effect; ++i)
        theta[effect_columns_[i].parameter].d(static_cast<Eigen::Index>(i - first)) = 1.0;
      effects_.apply_one<Dual>(effect, theta, q, chain_, bent.rigid, bent.around, motion);
      if (motion.undefined && out.undefined < 0) out.undefined = effect;
    }
    for (std::size_t i = first; i < last; ++i) {
      const auto lane = static_cast<Eigen::Index>(i - first);
      Vector3 d(motion.shift_B(0).d(lane), motion.shift_B(1).d(lane), motion.shift_B(2).d(lane));
      Vector3 e(motion.turn_B(0).d(lane), motion.turn_B(1).d(lane), motion.turn_B(2).d(lane));
      e = turn_rate * e;
      d += cross<double>(e, turned_arm);
      Motion6 column;
      column << R_MB * d, R_MB * e;
      for (int j = 0; j < chain_.joints(); ++j)
        if (const double rate = motion.dq[j].d(lane); rate != 0.0) column += by_joint[j] * rate;
      out.columns.col(effect_columns_[i].column) = column;
    }
    first = last;
  }
}

void GeometryDerivative::evaluate(std::span<const double> q, const MeasuredContext& context,
                                  Point& out, const Vector3& departure_B, int setup) const {
  const Transformd& X_MB = X_MB_[static_cast<std::size_t>(setup)];
  const Transformd& X_TG = X_TG_[static_cast<std::size_t>(setup)];
  MovedPose bent;
  bend(q, context, bent);
  out.undefined = bent.undefined;
  const ChainFrames& frames = bent.frames;
  const Matrix3& R_MB = X_MB.R;
  const Vector3 arm_B = frames.tip.R * X_TG.p;  // before the effects turn the tip
  const Vector3 p_B = frames.tip.p + bent.motion.shift_B + bent.turn * arm_B + departure_B;
  const Matrix3 R_BT = bent.turn * frames.tip.R;
  out.p_M = X_MB * p_B;
  out.R_MG = R_MB * R_BT * X_TG.R;
  const auto count = static_cast<Eigen::Index>(twists_.size());
  if (out.columns.cols() != count) out.columns.resize(6, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& t = twists_[k];
    if (t.slot == kSlotEffect) continue;
    Vector3 d_M, e_M;
    if ((t.slot == kSlotFrame && t.setup != state_.frame_of(setup)) ||
        (t.slot == kSlotTarget && t.setup != state_.target_of(setup))) {
      d_M = e_M = Vector3::Zero();  // of another set-up
    } else if (t.slot == kSlotFrame) {
      d_M = t.d + cross<double>(t.e, out.p_M - X_MB.p);
      e_M = t.e;
    } else if (t.slot == kSlotTarget) {
      const Matrix3 R_MT = R_MB * R_BT;
      d_M = R_MT * t.d;
      e_M = R_MT * t.e;
    } else {
      const Matrix3 R = t.slot < 0 ? Matrix3::Identity() : frames.joint[t.slot].R;
      const Vector3 o = t.slot < 0 ? Vector3::Zero() : frames.joint[t.slot].p;
      const Vector3 e_B = R * t.e;
      d_M = R_MB * (R * t.d + cross<double>(e_B, frames.tip.p - o) +
                    bent.turn * cross<double>(e_B, arm_B));
      e_M = R_MB * (bent.turn * e_B);
    }
    out.columns.col(k) << d_M, e_M;
  }
  if (!effect_columns_.empty() || !waves_.empty() || !series_.empty())
    effect_columns(q, bent, arm_B, R_MB, out);
}

}  // namespace plumb::offline

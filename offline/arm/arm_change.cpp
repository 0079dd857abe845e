// SPDX-License-Identifier: Apache-2.0
#include "arm/arm_change.hpp"

#include "formula/degree.hpp"

namespace plumb::offline {
namespace {

using Kind = Parameter::Kind;

double& dh_value(format::JointRow& row, Kind kind) {
  switch (kind) {
    case Kind::kTheta:
      return row.theta;
    case Kind::kD:
      return row.d;
    case Kind::kA:
      return row.a;
    case Kind::kAlpha:
      return row.alpha;
    default:
      return row.beta;
  }
}

double& twist_value(format::Twist& twist, int component) {
  return component < 3 ? twist.d[component] : twist.e[component - 3];
}

}  // namespace

Vector3 gathered(const std::vector<Parameter>& parameters, const Eigen::VectorXd& change, Kind kind,
                 int first_component, int setup) {
  Vector3 out = Vector3::Zero();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const int k = parameters[i].component - first_component;
    if (parameters[i].kind == kind && parameters[i].setup == setup && k >= 0 && k < 3)
      out(k) = change(i);
  }
  return out;
}

Transformd turned(const Vector3& e) { return exp({{0, 0, 0}, {e(0), e(1), e(2)}}); }

ArmState moved(const ArmState& start, const std::vector<Parameter>& parameters,
               const Eigen::VectorXd& change) {
  ArmState out = start;
  auto& rows = out.arm.calibrated.joints;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    switch (p.kind) {
      case Kind::kLinkTwist:
        twist_value(rows[p.joint].post, p.component) += change(i);
        break;
      case Kind::kTarget:
        out.target(p.setup).p[p.component] += change(i);
        break;
      case Kind::kPoint:
        out.frame(p.setup).p[p.component] -= change(i);
        break;
      case Kind::kArtefactLength:
        out.length(p.setup) += change(i);
        break;
      case Kind::kPlane:
      case Kind::kFrame:
      case Kind::kTargetRotation:
      case Kind::kEffect:
        break;
      default:
        dh_value(rows[p.joint], p.kind) += change(i);
    }
  }
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].of_effect())
      out.arm.effects[parameters[i].joint].parameters[parameters[i].component] += change(i);
  for (int k = 0; k < start.setups(); ++k) {
    const Vector3 shift = gathered(parameters, change, Kind::kFrame, 0, k);
    const Vector3 turn = gathered(parameters, change, Kind::kFrame, 3, k);
    if (!shift.isZero(0.0) || !turn.isZero(0.0))
      out.frame(k) = to_pose(from_pose(start.frame(k)) * translation(shift(0), shift(1), shift(2)) *
                             turned(turn));
    // A plane turns and shifts about the axes of its own frame.
    const Vector3 tilt = gathered(parameters, change, Kind::kPlane, 1, k);
    const double rise = gathered(parameters, change, Kind::kPlane, 0, k)(0);
    if (!tilt.isZero(0.0)) out.frame(k).q = to_pose(turned(tilt) * from_pose(start.frame(k))).q;
    if (rise != 0.0) out.frame(k).p[2] += rise;
    const Vector3 target_turn = gathered(parameters, change, Kind::kTargetRotation, 0, k);
    if (!target_turn.isZero(0.0))
      out.target(k).q = to_pose(from_pose({{}, start.target(k).q}) * turned(target_turn)).q;
  }
  return out;
}

double value_of(const ArmState& state, const Parameter& parameter) {
  if (parameter.of_effect())
    return state.arm.effects[parameter.joint].parameters[parameter.component];
  auto row = state.arm.calibrated.joints[parameter.joint];
  switch (parameter.kind) {
    case Kind::kLinkTwist:
      return twist_value(row.post, parameter.component);
    case Kind::kTarget:
      return state.target(parameter.setup).p[parameter.component];
    case Kind::kFrame:
      if (parameter.component < 3) return state.frame(parameter.setup).p[parameter.component];
      return rotation_vector(from_pose(state.frame(parameter.setup)).R)(parameter.component - 3);
    case Kind::kPoint:
      // The frame has the axes of the base and stands in the point.
      return -state.frame(parameter.setup).p[parameter.component];
    case Kind::kPlane:
      if (parameter.component == 0) return state.frame(parameter.setup).p[2];
      return rotation_vector(from_pose(state.frame(parameter.setup)).R)(parameter.component - 1);
    case Kind::kArtefactLength:
      return state.length(parameter.setup);
    case Kind::kTargetRotation:
      return rotation_vector(from_pose(state.target(parameter.setup)).R)(parameter.component);
    default:
      return dh_value(row, parameter.kind);
  }
}

ArmState unhidden(ArmState state) {
  for (auto& effect : state.arm.effects) {
    if (effect.formula.code.empty() || degree_of(effect.formula) != Degree::kCurved) continue;
    for (std::size_t k = 0; k < effect.parameters.size(); ++k)
      if (effect.parameters[k] == 0.0) effect.parameters[k] = effect.formula.parameters[k].typical;
  }
  return state;
}

}  // namespace plumb::offline

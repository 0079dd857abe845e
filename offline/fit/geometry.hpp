// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "fit/arm_state.hpp"
#include "plumb/runtime/effect_set.hpp"

namespace plumb::offline {

/// One number of the geometric model that a fit may change.
struct Parameter {
  enum class Kind {
    kTheta,
    kD,
    kA,
    kAlpha,
    kBeta,
    kLinkTwist,
    kFrame,
    kTarget,
    kTargetRotation,
    kEffect
  };
  Kind kind = Kind::kTheta;
  int joint = 0;      // row of the chain; effect: its place in the model
  int component = 0;  // twist: dx dy dz ex ey ez; frame the same; target: x y z; effect: parameter
  std::string name;   // "J2.d", "J3.post.ex", "frame.x", "target.z", "reversal.J2.h"

  bool is_length() const;
  bool of_robot() const;  // of the model rather than of frame and target
  bool of_effect() const { return kind == Kind::kEffect; }
};

/// Sum of all link lengths [m], at least 0.1: makes metres and radians comparable.
double reach(const format::Chain& chain);

/// Candidates of a cell in the order in which they are preferred when poses cannot tell two apart:
/// frame, target, then the arm from base to tip. With near-parallel neighbours Hayati's beta takes
/// the place of d. `with_orientation` adds the turn of the target.
enum class Orientation { kIgnored, kUsed };
std::vector<Parameter> candidate_parameters(const Cell& cell, Orientation orientation);

/// Every parameter of the effects that `arm` carries, effect by effect.
std::vector<Parameter> effect_parameters(const format::Model& arm);

/// The robot parameter of that name ("J2.d", "J3.post.ex"), if the chain has it.
std::optional<Parameter> robot_parameter(const format::Chain& chain, const std::string& name);

/// Change of each parameter from its start, shape (parameters,). DH values add; twists and frames
/// act by Exp; X_MB turns by Exp and shifts in base coordinates.
ArmState moved(const ArmState& start, const std::vector<Parameter>& parameters,
               const Eigen::VectorXd& change);

double value_of(const ArmState& state, const Parameter& parameter);

/// Exact derivative of the measured point and orientation by each parameter, from one chain
/// evaluation: every parameter is a constant twist in the frame behind some joint, and a twist
/// (d, e) in a frame (R, o) moves the tip p by R d + (R e) x (p - o).
class GeometryDerivative {
 public:
  GeometryDerivative(const GeometryDerivative&) = delete;
  GeometryDerivative& operator=(const GeometryDerivative&) = delete;
  GeometryDerivative(const ArmState& start, const std::vector<Parameter>& parameters,
                     const Eigen::VectorXd& change);

  const ArmState& state() const { return state_; }

  struct Point {
    Vector3 p_M;                                       // predicted point, measurement frame [m]
    Matrix3 R_MG;                                      // predicted orientation of the reflector
    Eigen::Matrix<double, 6, Eigen::Dynamic> columns;  // rows 0-2 of p_M [m], 3-5 rotation [rad]
    int undefined = -1;  // an effect that has no value here, or no slope, and was left out
  };
  /// q: shape (joints,). `out.columns` is resized once and reused. Columns of geometry leave out
  /// that it changes the loads of the effects a little; those of effects are exact.
  void evaluate(std::span<const double> q, const Context& context, Point& out) const;

  /// Sensors in the order in which the context must hold them.
  const std::vector<std::string>& sensors() const { return sensors_; }

 private:
  struct SlotTwist {
    int slot;  // joint behind which the frame sits, -1 = base; frame and target have their own
    Vector3 d, e;
  };
  SlotTwist slot_twist(const Parameter& parameter) const;
  struct Bent;
  void bend(std::span<const double> q, const Context& context, Bent& out) const;
  void effect_columns(std::span<const double> q, const Bent& bent, const Vector3& arm_B,
                      Point& out) const;

  ArmState state_;
  Chain chain_;
  Transformd X_MB_;
  Transformd X_TG_;
  std::vector<SlotTwist> twists_;
  struct EffectColumn {
    int effect, parameter;
    Eigen::Index column;
  };
  std::vector<EffectColumn> effect_columns_;  // effect by effect
  EffectSet effects_;                         // refers to state_
  std::vector<std::string> sensors_;
};

}  // namespace plumb::offline

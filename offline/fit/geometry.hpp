// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "fit/arm_state.hpp"

namespace plumb::offline {

/// One number of the geometric model that a fit may change.
struct Parameter {
  enum class Kind { kTheta, kD, kA, kAlpha, kBeta, kLinkTwist, kFrame, kTarget, kTargetRotation };
  Kind kind = Kind::kTheta;
  int joint = 0;      // row of the chain
  int component = 0;  // twist: dx dy dz ex ey ez; frame the same; target: x y z
  std::string name;   // "J2.d", "J3.post.ex", "frame.x", "target.z"

  bool is_length() const;
  bool of_robot() const;
};

/// Sum of all link lengths [m], at least 0.1: makes metres and radians comparable.
double reach(const format::Chain& chain);

/// Candidates of a cell in the order in which they are preferred when poses cannot tell two apart:
/// frame, target, then the arm from base to tip. With near-parallel neighbours Hayati's beta takes
/// the place of d. `with_orientation` adds the turn of the target.
enum class Orientation { kIgnored, kUsed };
std::vector<Parameter> candidate_parameters(const Cell& cell, Orientation orientation);

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
  GeometryDerivative(const ArmState& start, const std::vector<Parameter>& parameters,
                     const Eigen::VectorXd& change);

  const ArmState& state() const { return state_; }

  struct Point {
    Vector3 p_M;                                       // predicted point, measurement frame [m]
    Matrix3 R_MG;                                      // predicted orientation of the reflector
    Eigen::Matrix<double, 6, Eigen::Dynamic> columns;  // rows 0-2 of p_M [m], 3-5 rotation [rad]
  };
  /// q: shape (joints,). `out.columns` is resized once and reused.
  void evaluate(std::span<const double> q, Point& out) const;

 private:
  struct SlotTwist {
    int slot;  // joint behind which the frame sits, -1 = base; frame and target have their own
    Vector3 d, e;
  };
  SlotTwist slot_twist(const Parameter& parameter) const;

  ArmState state_;
  Chain chain_;
  Transformd X_MB_;
  Transformd X_TG_;
  std::vector<SlotTwist> twists_;
};

}  // namespace plumb::offline

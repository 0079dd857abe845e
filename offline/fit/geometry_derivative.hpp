// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "fit/arm_state.hpp"
#include "fit/parameter.hpp"
#include "plumb/runtime/effect_set.hpp"

namespace plumb::offline {

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
  /// departure_B: moves the point besides [m].
  void evaluate(std::span<const double> q, const Context& context, Point& out,
                const Vector3& departure_B = Vector3::Zero()) const;

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

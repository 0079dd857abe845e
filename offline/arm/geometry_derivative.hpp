// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/fitted_effects.hpp"
#include "arm/parameter.hpp"

namespace plumb::offline {

/// Exact derivative of the measured point and orientation by each parameter, from one evaluation of
/// the chain: every parameter is a constant twist in the frame after some joint, and a twist (d, e)
/// in a frame (R, o) moves the tip p by R d + (R e) x (p - o).
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
  /// q: shape (joints,). `out.columns` is resized once and reused. Columns of geometry neglect that
  /// geometry slightly changes the loads of the effects; those of effects are exact. departure_B:
  /// is added to the predicted point in the base frame [m]. setup: selects frame and reflector.
  void evaluate(std::span<const double> q, const MeasuredContext& context, Point& out,
                const Vector3& departure_B = Vector3::Zero(), int setup = 0) const;

  /// Pose of the base in the measurement frame of a set-up.
  const Transformd& X_MB(int setup) const { return X_MB_[static_cast<std::size_t>(setup)]; }

  /// Temperature sensors in the order in which the context must hold them.
  const std::vector<std::string>& sensors() const { return sensors_; }

 private:
  struct SlotTwist {
    int slot;  // joint behind which the frame sits, -1 = base; frame and target have their own
    Vector3 d, e;
    int setup = 0;  // of frame and target
  };
  SlotTwist slot_twist(const Parameter& parameter) const;
  struct MovedPose;
  void bend(std::span<const double> q, const MeasuredContext& context, MovedPose& out) const;
  void add_column(const Parameter& parameter, Eigen::Index column);
  void apply_wave(std::size_t wave, std::span<const double> q, MovedPose& out) const;
  void add_series_column(const Parameter& parameter, Eigen::Index column);
  void effect_columns(std::span<const double> q, const MovedPose& bent, const Vector3& arm_B,
                      const Matrix3& R_MB, Point& out) const;

  ArmState state_;
  Chain chain_;
  std::vector<Transformd> X_MB_, X_TG_;  // by set-up
  std::vector<SlotTwist> twists_;
  struct EffectColumn {
    int effect, parameter;
    Eigen::Index column;
  };
  std::vector<EffectColumn> effect_columns_;  // effect by effect, without those of waves

  /// A gear ripple at one joint. There may be dozens of them, and each turns its joint in
  /// proportion to its two amplitudes.
  struct Wave {
    int effect, joint;
    std::array<Eigen::Index, 2> column{-1, -1};  // -1: not fitted
  };
  std::vector<Wave> waves_;  // those with a fitted amplitude

  /// The columns of the amplitudes of a series of waves at one joint. Each amplitude turns the
  /// joint in proportion to itself.
  struct SeriesColumns {
    int effect, joint;
    std::vector<Eigen::Index> column;  // -1: not fitted
  };
  std::vector<SeriesColumns> series_;
  FittedEffects effects_;     // refers to state_
  std::vector<int> wave_of_;  // index of every effect among the waves, or -1
  std::vector<std::string> sensors_;
};

}  // namespace plumb::offline

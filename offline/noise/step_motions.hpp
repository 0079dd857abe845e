// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "noise/moving_part.hpp"
#include "noise/series.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {

/// How the measured point of each visit moves if the tool, the base or a joint moves by one unit,
/// in the measurement frame, and the residual there [m]. Missing axes are 0.
class StepMotions {
 public:
  /// Uses the frames of the chain alone; effects and trees change them too little to matter. Keeps
  /// references to `state` and `measured`.
  StepMotions(const ArmState& state, const Measurements& measured, Series series);

  int size() const { return static_cast<int>(rows_.size()); }
  int joints() const { return static_cast<int>(turns_.size()); }
  int axes() const { return axes_; }
  bool turns(int joint) const { return turns_[static_cast<std::size_t>(joint)]; }
  const std::vector<int>& rows() const { return rows_; }  // first of each visit
  const std::vector<int>& last_rows() const { return last_rows_; }

  Eigen::Vector3d error(int visit) const { return error_.col(visit); }
  double squares() const { return error_.squaredNorm(); }

  /// Motion of the point per turn [m/rad] or shift [m/m] of joint j.
  Eigen::Vector3d joint(int visit, int j) const { return joint_[j].col(visit); }

  /// Tool, 3 columns: shift of the reflector along the tool's axes. Base, 6 columns: shift along
  /// the axes of the measurement frame, then turn about these axes through the mean of the points.
  /// Joint, 1 column.
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6>;
  Columns columns(int visit, MotionSource source, int j) const;

 private:
  /// Frames of the chain at a visit; the set-up that it was measured in.
  int frames(int visit, ChainFrames& out) const;

  const Measurements& measured_;
  Chain chain_;
  std::vector<Transformd> X_MB_;  // by set-up
  std::vector<int> rows_, last_rows_;
  std::vector<bool> turns_;
  int axes_ = 3;
  Eigen::Matrix3Xd error_, from_middle_;
  std::vector<Eigen::Matrix3Xd> joint_;
  Eigen::Vector3d mask_;
};

}  // namespace plumb::offline

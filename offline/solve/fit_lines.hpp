// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "solve/pose_lines.hpp"
#include "solve/prior_lines.hpp"

namespace plumb::offline {

/// All lines of a least-squares problem: those of the poses, then those of the priors. All poses
/// are evaluated in one call, so that the constant transforms of the chain are multiplied only
/// once.
class FitLines {
 public:
  /// Keeps references to all three.
  FitLines(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters);

  int count() const { return static_cast<int>(table_.lines()) + priors_.count(); }

  /// residual: shape (count,); jacobian: derivatives of the residuals, row by row, or null if they
  /// are not wanted. Returns false if a residual is not finite.
  bool evaluate(const Eigen::VectorXd& change, double* residual, double* jacobian) const;

  /// The first row of the last evaluation at which an effect has no value.
  const PoseLines::Undefined& undefined() const { return undefined_; }

 private:
  const FitData& data_;
  const ArmState& start_;
  const std::vector<Parameter>& parameters_;
  LineTable table_;
  PoseLines poses_;
  PriorLines priors_;
  mutable PoseLines::Undefined undefined_;
};

}  // namespace plumb::offline

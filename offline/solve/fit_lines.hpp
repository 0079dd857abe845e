// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "solve/pose_lines.hpp"
#include "solve/prior_lines.hpp"

namespace plumb::offline {

/// All lines of a least-squares problem: those of the poses, then those of the priors. The poses
/// are evaluated together, so the chain is folded once.
class FitLines {
 public:
  /// Keeps references to all three.
  FitLines(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters);

  int count() const { return data_.residual_count() + priors_.count(); }

  /// residual: shape (count,); jacobian, unless null: how they change, line by line. Returns false
  /// where a residual has no finite value.
  bool evaluate(const Eigen::VectorXd& change, double* residual, double* jacobian) const;

  /// Of the last evaluation.
  const PoseLines::Undefined& undefined() const { return undefined_; }

 private:
  const FitData& data_;
  const ArmState& start_;
  const std::vector<Parameter>& parameters_;
  PoseLines poses_;
  PriorLines priors_;
  mutable PoseLines::Undefined undefined_;
};

}  // namespace plumb::offline

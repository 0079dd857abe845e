// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "fit/likeness.hpp"
#include "program/problem.hpp"
#include "solve/known_arm.hpp"
#include "solve/outlier.hpp"

namespace plumb::offline {

/// A fitted number. SI.
struct Estimate {
  std::string name;  // "J2.d", "frame.x", "target.z"
  bool is_length = false;
  bool of_robot = false;  // false: of the measurement, thrown away
  std::string unit = {};  // SI, of an effect's parameter; else empty
  double value = 0.0;     // frame: change from the start, so 0 is not meaningful
  double nominal = 0.0;
  double std = 0.0;  // 1 sigma
};

struct Calibration {
  ArmState state;
  std::vector<Outlier> outliers;    // poses that the others contradict: not fitted, farthest first
  std::vector<Problem> remarks;     // what the numbers look like
  std::vector<Estimate> estimates;  // the identifiable subset, in covariance order
  std::vector<Parameter> parameters;  // the same ones
  std::vector<std::string> held;      // kept at nominal: these poses say less about them
  Eigen::MatrixXd covariance;         // SI
  int rank = 0;                       // independent columns, of all candidates
  double calibrability = 0.0;         // cond_2(J^T J), SI columns
  double series_dof = 0.0;            // of series of waves, see Solution
  double decided = 0.0;               // numbers, each by how much the readings decide it
  std::optional<Likeness> likeness;   // with an earlier arm, if the cell names one
  KnownArm known;                     // what that one says of this
  double sigma0 = 0.0;                // sqrt(chi^2 / dof) of the weighted residuals
  int iterations = 0;
};

}  // namespace plumb::offline

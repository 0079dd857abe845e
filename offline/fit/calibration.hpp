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
  bool of_robot = false;  // false: of frame or target, which are not compiled
  std::string unit = {};  // SI, of an effect's parameter; else empty
  double value = 0.0;     // of the frame: its place or turn in the measurement frame
  double nominal = 0.0;
  double std = 0.0;  // 1 sigma
};

struct Calibration {
  ArmState state;
  std::vector<Outlier> outliers;    // poses that the others contradict: not fitted, farthest first
  std::vector<Problem> remarks;     // warnings and notes about the fit
  std::vector<Estimate> estimates;  // the identifiable subset, in covariance order
  std::vector<Parameter> parameters;  // those of the estimates, in the same order
  std::vector<std::string> held;      // kept at nominal: these poses do not determine them
  Eigen::MatrixXd covariance;         // SI
  int rank = 0;                       // number of independent columns of all candidates
  double calibrability = 0.0;         // cond_2(J^T J), SI columns
  double series_dof = 0.0;            // of the series of waves, as in Solution
  double decided = 0.0;               // effective number of parameters: each counts as the share
                                      // of it that the readings decide rather than a prior
  std::optional<Likeness> likeness;   // to an earlier arm, if the cell names one
  KnownArm known;                     // what follows from both for the numbers they share
  double sigma0 = 0.0;                // sqrt(chi^2 / dof) of the weighted residuals
  int iterations = 0;
};

}  // namespace plumb::offline

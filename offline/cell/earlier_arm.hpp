// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <unordered_set>
#include <vector>

namespace plumb::offline {

/// The numbers of an arm as an earlier run found them: of this arm, or of a sister.
struct EarlierArm {
  struct Number {
    std::string name;                   // "J2.d", "joint_compliance.J2.c"
    double value = 0.0, nominal = 0.0;  // SI
    bool of_effect = false;
  };
  /// A row of the arm as it was calibrated; what was not fitted is nominal.
  struct Row {
    std::string joint;
    bool prismatic = false;
    double theta = 0.0, d = 0.0, a = 0.0, alpha = 0.0;  // SI
  };
  std::filesystem::path run;  // folder
  bool modified = false;      // rows in Craig's convention
  std::vector<Row> rows;
  std::vector<Number> numbers;
  Eigen::MatrixXd covariance;        // of these numbers, SI
  std::array<double, 3> target_T{};  // where its reflector sat in the frame of the tool [m]
  double left_m = 0.0;               // RMS of a coordinate that the run leaves at held-out poses
  std::vector<std::string> inputs;   // check sums of all measurement files that it goes back to
  std::unordered_set<std::string> readings;  // their digests, as far as the runs are still there
  std::string check_sum;                     // of run.json
};

/// Reads the run of `place`: a folder of a run (runs/0003), or a folder of a cell, whose latest run
/// is meant. Throws Failure (kInput, E-CELL-EARLIER) if there is none, or if it was edited, was cut
/// off, or knows no number of the arm.
EarlierArm earlier_arm(const std::filesystem::path& place);

}  // namespace plumb::offline

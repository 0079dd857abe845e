// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "twin/nominal_arm.hpp"

namespace plumb::offline::twin {

/// The path of the arm, which stops at every station. One row of joint positions of the nominal arm
/// for each station [rad, m].
struct Path {
  RowsN q;
  int stations() const { return static_cast<int>(q.rows()); }
};

/// Random stations inside the joint limits, in one configuration, each near the one before, and
/// with all ways away from singular poses. `range` is the share of the range of each joint that is
/// used, around its middle.
/// Throws Failure (kNumbersSayNo) if so many cannot be found.
Path generated_path(const Cell& cell, int stations, double range, std::uint64_t seed);

/// Reads a CSV file of targets like those of plumb correct: tool poses in the base frame with joint
/// positions q1_deg ... near them.
/// Throws Failure (kInput).
Path path_from(const Cell& cell, const std::filesystem::path& file);

/// How fast the arm may move between stations.
struct SpeedLimits {
  double joint_rad_per_s = 2.0;  // or [m/s]
  double tool_m_per_s = 1.5;
  double tool_rad_per_s = 4.0;
};

/// A move between two stations. All joints begin and end together, with zero speed and acceleration
/// at both ends.
///   q(s) = a + (b - a)(10 s^3 - 15 s^4 + 6 s^5)
class Move {
 public:
  Move(const NominalArm& arm, VectorXd from, VectorXd to, const SpeedLimits& limits);
  double duration_s() const { return duration_s_; }
  VectorXd at(double time_s) const;

 private:
  VectorXd from_, to_;
  double duration_s_;
};

}  // namespace plumb::offline::twin

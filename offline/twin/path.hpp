// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "twin/nominal_arm.hpp"

namespace plumb::offline::twin {

/// Where the controller takes the arm: it stops at every station. Joints of the nominal arm, a row
/// a station [rad, m].
struct Path {
  RowsN q;
  int stations() const { return static_cast<int>(q.rows()); }
};

/// Stations inside the joint limits, one configuration, away from singular poses also in between,
/// each near the one before. `range`: share of each joint's range, around its middle.
/// Throws Failure (kNumbersSayNo) if the arm has not so many.
Path generated_path(const Cell& cell, int stations, double range, std::uint64_t seed);

/// A targets CSV as plumb correct reads it: tool poses in the base frame with q1_deg ... near them.
/// Throws Failure (kInput).
Path path_from(const Cell& cell, const std::filesystem::path& file);

/// How fast the arm may move between stations.
struct SpeedLimits {
  double joint_rad_per_s = 2.0;  // or [m/s]
  double tool_m_per_s = 1.5;
  double tool_rad_per_s = 4.0;
};

/// How it does: all joints begin and end together, without a jerk.
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

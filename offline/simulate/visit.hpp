// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "simulate/arm.hpp"

namespace plumb::offline::sim {

/// One reading: where the arm stands, how it got there, and what surrounds it.
struct Visit {
  VectorXd q;          // [rad] or [m]
  VectorXd direction;  // -1, 0 (never moved) or 1: sign of each joint's last move
  VectorXd travel;     // size of that move [rad] or [m]
  VectorXd before;     // where the last move of the arm began
  double time_s = 0.0;
  Payload payload;
  double room_K = 0.0;  // air, over 20 degC
  VectorXd zone_K;      // over 20 degC: column, then the link behind each joint
};

/// Visits in the order of q, starting from rest in the middle of the joint limits. A joint that
/// does not move keeps its last direction and travel; a pose read again keeps all of its last move.
std::vector<Visit> drive(const RowsN& q, const VectorXd& start, double seconds_per_pose);

}  // namespace plumb::offline::sim

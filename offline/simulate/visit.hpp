// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "simulate/arm.hpp"
#include "simulate/stated_visit.hpp"

namespace plumb::offline::sim {

/// One reading: the position of the arm, the last move to it, and the conditions at that time.
struct Visit {
  VectorXd q;          // [rad] or [m]
  VectorXd direction;  // -1, 0 (never moved) or 1: sign of each joint's last move
  VectorXd travel;     // size of that move [rad] or [m]
  VectorXd before;     // joint positions before the last move of the arm
  double time_s = 0.0;
  double running_s = 0.0;  // since the drives were switched on
  Payload payload;
  double room_K = 0.0;  // air temperature above 20 degC
  VectorXd zone_K;      // above 20 degC: of the column, then of the link behind each joint
};

/// The visits in the order of q. The arm starts at rest in the middle of the joint limits. A joint
/// that does not move keeps its last direction and travel, and a repeated reading of a pose keeps
/// the whole last move.
std::vector<Visit> drive(const RowsN& q, const VectorXd& start, double seconds_per_pose);

/// Puts each stated visit into the visit with the same index. An empty list changes nothing. Throws
/// Failure (kUsage, E-SIM-PLAN) if the numbers of both differ.
void put_stated(const std::vector<StatedVisit>& stated, std::vector<Visit>& visits);

}  // namespace plumb::offline::sim

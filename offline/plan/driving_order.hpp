// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// An order in which to drive through poses: nearest neighbour after nearest neighbour, then pairs
/// of moves uncrossed until nothing shortens (2-opt). The length of a move is the largest
/// share of its range that any joint needs. q: shape (n, joints); range: of each joint, > 0; start:
/// where the arm stands.
std::vector<int> driving_order(const RowsN& q, const Eigen::VectorXd& range,
                               const Eigen::VectorXd& start);

/// Length of that drive, in ranges of the joint that is slowest.
double driving_length(const RowsN& q, const std::vector<int>& order, const Eigen::VectorXd& range,
                      const Eigen::VectorXd& start);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "arm/parameter.hpp"
#include "cell/cell.hpp"

namespace plumb::offline {

/// How many times farther from nominal than the prior of the cell says an arm is built.
struct BuiltTimes {
  double lengths = 1.0, angles = 1.0;
};

/// Combinations of the arm's numbers that the poses hardly determine. Each row of `weights` times
/// the differences of the numbers from nominal is a distance in standard deviations of the prior.
struct WeakDirections {
  std::vector<Parameter> parameters;
  Eigen::MatrixXd weights;  // shape (directions, parameters) [1/SI]
  Eigen::VectorXd share;    // share of each number that lies in these directions, 0 to 1
  BuiltTimes built;         // by which the prior is wider than the cell says
};

/// Names of the numbers of which a clear share lies in these directions, in their order.
std::vector<std::string> names_of(const WeakDirections& weak);

/// N-FIT-PRIOR: which numbers of the arm are held near nominal, in words. `weak` is not empty.
Problem held_near_nominal(const WeakDirections& weak, const Cell& cell);

}  // namespace plumb::offline

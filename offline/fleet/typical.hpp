// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/cell_summary.hpp"

namespace plumb::offline::fleet {

/// How a number of the arm lies in arms of one model. SI.
struct Typical {
  std::string name, effect, unit;
  double mean = 0.0;       // difference from nominal, or size
  double sd = 0.0;         // from arm to arm, noise of the fits taken off
  double shrinkage = 0.0;  // 0 to 1: of an arm's own estimate, how much the mean counts, on average
  int arms = 0;            // that tell
};

/// At least so many arms of a model are needed to learn from them.
inline constexpr int kFewestArms = 5;

/// Empirical Bayes [Efron & Morris 1975]: the true numbers theta_i of arm i are N(mu, diag sd^2),
/// and its fit says x_i ~ N(theta_i, C_i) with the whole covariance of its numbers. mu and sd by
/// expectation maximisation [Dempster, Laird & Rubin 1977] over all arms; a number that a fit held
/// at nominal says nothing. Empty if there are fewer than kFewestArms.
/// `start`: of nearly the same arms, from where it settles in a few iterations; or none.
/// Cost: iterations * arms * numbers^3.
std::vector<Typical> learn_typical(const std::vector<const CellSummary*>& arms,
                                   const std::vector<Typical>& start = {});

}  // namespace plumb::offline::fleet

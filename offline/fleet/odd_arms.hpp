// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/typical.hpp"

namespace plumb::offline::fleet {

/// An arm that is unlike its sisters.
struct OddArm {
  std::string cell;
  std::string number;              // the one that is farthest from theirs
  double value = 0.0, mean = 0.0;  // its, and theirs; SI
  std::string unit;
  double times = 0.0;   // how far, in standard deviations of the sisters and of its own fit
  double chance = 0.0;  // probability that the oddest of so many arms is so odd by chance
};

/// What is typical, and the arms that are not: those are left out of what is learnt.
struct Sisters {
  std::vector<Typical> typical;
  std::vector<OddArm> odd;
};

/// The chance that any arm of a model is called odd although all of them are alike.
inline constexpr double kOddByChance = 0.01;

/// Takes out the oddest arm for as long as it is too odd to be one of them, and learns anew: by the
/// distance (x - mu)^T (C + diag sd^2)^-1 (x - mu) of its numbers from the others' mean, judged by
/// F and the number of arms. At most a quarter of the arms are taken out.
Sisters learn_sisters(std::vector<const CellSummary*> arms);

}  // namespace plumb::offline::fleet

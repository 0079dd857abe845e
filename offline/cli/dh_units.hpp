// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/table.hpp"

namespace plumb::offline::cli {

/// The unit that numbers of a DH table seem to be in, for a proposal.
struct LikelyUnit {
  std::string unit;    // "rad"; empty if the numbers do not tell
  std::string reason;  // "1.570796 is pi/2"
};

/// Angles beyond a turn of 2 pi are degrees; multiples of pi/4 within it are radians. Lengths of
/// more than 20 are millimetres, less than 5 are metres. `numbers`: all of that quantity.
LikelyUnit likely_unit(Quantity quantity, const std::vector<double>& numbers);

}  // namespace plumb::offline::cli

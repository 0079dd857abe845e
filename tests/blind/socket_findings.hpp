// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/blind/socket_marks.hpp"

namespace plumb::offline {

/// What diagnoses said of arms whose joints J2 and J3 yield to gravity, and of the same arms where
/// nothing is hidden.
struct SocketFindings {
  SocketWay way;
  int arms = 0;
  int first = 0;    // a load is the first cause that is named
  int certain = 0;  // of these, without another cause that the readings do not exclude
  int wrong = 0;    // another cause is named with certainty
  int unseen = 0;   // nothing was found
  int made_up = 0;  // a cause was named with certainty where nothing is hidden
};

/// `arms` arms, seeds from `seed` on.
SocketFindings socket_findings(const SocketWay& way, int arms, std::uint64_t seed);

/// The last table of docs/without-a-tracker.md.
std::string findings_table(const std::vector<SocketFindings>& all);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "program/outcome.hpp"
#include "rt/check.hpp"

namespace plumb::drivers::rt {

/// What the doctor saw.
struct Examination {
  int cycle_us = 4000;
  std::vector<Check> checks;
  std::vector<std::string> can;  // names of CAN interfaces

  bool fit() const { return obstacles(checks, cycle_us).empty(); }
};

/// "fit for a 4 ms cycle: no, because the kernel is not PREEMPT_RT; ..."
std::string verdict(const Examination& examination);

/// A line a check, its remedy below, and the verdict at the end.
std::string to_text(const Examination& examination);

/// {fit, cycle_us, verdict, checks[{check, what, grant, needed, decides, why, remedy}],
/// can_interfaces[]}
Json to_json(const Examination& examination);

}  // namespace plumb::drivers::rt

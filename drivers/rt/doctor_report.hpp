// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/can_interface.hpp"
#include "program/outcome.hpp"
#include "rt/check.hpp"

namespace plumb::drivers::rt {

/// The result of plumb-rt doctor.
struct Examination {
  int cycle_us = 4000;
  std::vector<Check> checks;
  std::vector<CanInterface> can;

  bool fit() const { return obstacles(checks, cycle_us).empty(); }
};

/// "fit for a 4 ms cycle: no, because the kernel is not PREEMPT_RT; ..."
std::string verdict(const Examination& examination);

/// One line per check with its remedy below, and the verdict at the end.
std::string to_text(const Examination& examination);

/// {fit, cycle_us, verdict, checks[{check, what, grant, needed, why, remedy}],
/// can_interfaces[{name, kind, state, fd, bit_rate, data_bit_rate, restart_ms}]}; bit rates in
/// [bit/s], null with a reason where there is none or it is not known.
Json to_json(const Examination& examination);

}  // namespace plumb::drivers::rt

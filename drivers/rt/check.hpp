// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plumb/drivers/finding.hpp"
#include "plumb/drivers/rt_step.hpp"
#include "rt/machine_files.hpp"

namespace plumb::drivers::rt {

/// When a machine that fails a check is unfit.
enum class Need : std::uint8_t {
  kAlways,      // without it nothing bounds how late the cycle runs
  kShortCycle,  // delays of up to some hundred microseconds: unfit from 1 kHz on
  kAdvice,      // worth having; never decides
};

/// "always", "short cycle", "advice".
const char* to_string(Need need);

struct Check {
  std::string id;  // stable, for programs: "kernel", "sched_fifo"
  Need need = Need::kAdvice;
  Finding finding;
};

/// A cycle of this or less is a short one.
inline constexpr int kShortCycle_us = 1000;

/// What `files` and the steps that were tried tell, in the order in which it is shown.
std::vector<Check> examine(const MachineFiles& files, std::span<const RtStep> steps);

std::vector<Check> kernel_checks(const MachineFiles& files);
std::vector<Check> process_checks(const MachineFiles& files, std::span<const RtStep> steps);
std::vector<Check> processor_checks(const MachineFiles& files, std::span<const RtStep> steps);

/// CAN interfaces present: network interfaces of type ARPHRD_CAN.
std::vector<std::string> can_interfaces(const MachineFiles& files);
Check can_check(const MachineFiles& files);

/// The check that one step of an RtProcess is.
Check step_check(std::string id, Need need, std::span<const RtStep> steps, RtStepKind kind);

/// Why the machine is unfit for this cycle: needed checks that were denied, and those always needed
/// that could not be made.
std::vector<Check> obstacles(const std::vector<Check>& checks, int cycle_us);

}  // namespace plumb::drivers::rt

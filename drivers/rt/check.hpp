// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plumb/drivers/can_interface.hpp"
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

/// What `files`, the steps that were tried and the CAN interfaces tell, in the order in which it is
/// shown.
std::vector<Check> examine(const MachineFiles& files, std::span<const RtStep> steps,
                           std::span<const CanInterface> can);

std::vector<Check> kernel_checks(const MachineFiles& files);
std::vector<Check> process_checks(const MachineFiles& files, std::span<const RtStep> steps);
std::vector<Check> processor_checks(const MachineFiles& files, std::span<const RtStep> steps);

/// A check an interface, "can:NAME": its state, frames and bit rates. One, skipped, if there is
/// none.
std::vector<Check> can_checks(std::span<const CanInterface> interfaces);

/// CAN interfaces as files tell of them, network interfaces of type ARPHRD_CAN: without their kind
/// and bit rates, which no file holds. For a copy of another machine; of this one,
/// read_can_interfaces() knows more.
std::vector<CanInterface> can_interfaces(const MachineFiles& files);

enum class CanState : std::uint8_t { kUp, kDown, kBusOff };
CanState state_of(const CanInterface& interface);

/// "up", "down", "bus-off".
const char* to_string(CanState state);

/// The check that one step of an RtProcess is.
Check step_check(std::string id, Need need, std::span<const RtStep> steps, RtStepKind kind);

/// Why the machine is unfit for this cycle: needed checks that were denied, and those always needed
/// that could not be made.
std::vector<Check> obstacles(const std::vector<Check>& checks, int cycle_us);

}  // namespace plumb::drivers::rt

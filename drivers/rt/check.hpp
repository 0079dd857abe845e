// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "plumb/drivers/can_interface.hpp"
#include "plumb/drivers/finding.hpp"
#include "plumb/drivers/rt_step.hpp"
#include "rt/machine_files.hpp"

namespace plumb::drivers::rt {

/// For which cycles a failed check makes a machine unfit.
enum class Need : std::uint8_t {
  kAlways,      // for every cycle: without it the latency has no bound
  kShortCycle,  // for cycles up to kShortCycle_us: it delays by up to some 100 us
  kAdvice,      // for none; it is only recommended
};

/// "always", "short cycle", "advice".
const char* to_string(Need need);

struct Check {
  std::string id;  // stable name for programs: "kernel", "sched_fifo"
  Need need = Need::kAdvice;
  Finding finding;
};

/// The longest period [us] that counts as a short cycle.
inline constexpr int kShortCycle_us = 1000;

/// All checks of a machine in the order of display, from its files, the real-time steps that were
/// tried, and its CAN interfaces.
std::vector<Check> examine(const MachineFiles& files, std::span<const RtStep> steps,
                           std::span<const CanInterface> can);

std::vector<Check> kernel_checks(const MachineFiles& files);
std::vector<Check> process_checks(const MachineFiles& files, std::span<const RtStep> steps);
std::vector<Check> processor_checks(const MachineFiles& files, std::span<const RtStep> steps);

/// Whether deploy folders must be signed here, and by which keys; one check more, "key", for each
/// file of keys that is not used. `etc`: the folder of this machine's settings.
std::vector<Check> signing_checks(const std::filesystem::path& etc);

/// One check "packing" for each place below `store` that runs and whose controller packs its
/// registers otherwise than the layout says. Asks each one that runs, for some seconds at most.
std::vector<Check> packing_checks(const std::filesystem::path& store);

/// One check "can:NAME" per interface: its state, frame format and bit rates. If there is no
/// interface, a single check with Grant::kSkipped.
std::vector<Check> can_checks(std::span<const CanInterface> interfaces);

/// The CAN interfaces (network interfaces of type ARPHRD_CAN) according to the files, which contain
/// neither their kind nor their bit rates. For the copied files of another machine; for this
/// machine read_can_interfaces() returns more.
std::vector<CanInterface> can_interfaces(const MachineFiles& files);

enum class CanState : std::uint8_t { kUp, kDown, kBusOff };
CanState state_of(const CanInterface& interface);

/// "up", "down", "bus-off".
const char* to_string(CanState state);

/// The check whose result is that of one step of an RtProcess.
Check step_check(std::string id, Need need, std::span<const RtStep> steps, RtStepKind kind);

/// The checks that make the machine unfit for this cycle: needed checks that were denied, and
/// checks with Need::kAlways that could not be made.
std::vector<Check> obstacles(const std::vector<Check>& checks, int cycle_us);

}  // namespace plumb::drivers::rt

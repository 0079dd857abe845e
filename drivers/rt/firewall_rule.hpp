// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/bus_source.hpp"

namespace plumb::drivers::rt {

/// The user as whom plumb-rt@.service runs.
inline constexpr char kServiceUser[] = "plumb";

/// Statements of nftables that keep one bus of a place for one user of this machine.
struct FirewallRule {
  std::filesystem::path file;             // relative to the root of the machine
  std::string says;                       // in words, what it does
  std::string without;                    // in words, what is so without it
  std::vector<std::string> output = {};   // on what this machine sends
  std::vector<std::string> input = {};    // on what it receives
  std::vector<std::string> forward = {};  // on what it forwards, as for containers
  std::string can = {};                   // instead of all: on what it sends on this interface
};

/// The rule for a bus; nothing if there can be none, or if the endpoint is none that nftables
/// understands, whatever rt.toml says.
std::optional<FirewallRule> firewall_rule(const std::string& place, const BusEndpoint& bus,
                                          const std::string& user);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/check.hpp"
#include "rt/firewall_rule.hpp"
#include "rt/machine_settings.hpp"

namespace plumb::drivers::rt {

/// What was found in the places of a machine.
struct FirewallRules {
  std::vector<FirewallRule> rules = {};
  std::vector<std::string> unread = {};  // "cell4: ...", with the reason
};

/// The rules for the buses of all places below `store`.
FirewallRules firewall_rules(const std::filesystem::path& store);

/// One file for all rules about TCP, and one for each CAN interface, since that may come later.
std::vector<MachineSetting> firewall_settings(const std::vector<FirewallRule>& rules);

/// The rules that the kernel has, as nft lists them; nothing, with the reason, if it cannot be
/// asked.
struct FirewallInForce {
  std::optional<std::string> listed = {};
  std::string why_not = {};
  std::string remedy = {};
};
FirewallInForce read_firewall();

/// True if nft is installed.
bool can_load_firewall();

/// Lets the kernel take a file of rules. Returns what nft says against it; nothing if it is done.
std::optional<std::string> load_firewall(const std::filesystem::path& file);

/// One check "firewall" for each rule: is it in force.
std::vector<Check> firewall_checks(const FirewallRules& found, const FirewallInForce& now);

}  // namespace plumb::drivers::rt

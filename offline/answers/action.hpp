// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline {

/// A command to type next: the words that follow `plumb`.
struct Action {
  std::string command;
  std::string why;  // what it is for; may be empty

  std::string typed() const { return "plumb " + command; }
};

/// "diagnose   # which effect is missing?" is a command and its reason.
inline Action action_of(const std::string& words) {
  const auto reason = words.find(" # ");
  const std::string command = words.substr(0, reason);
  return {.command = command.substr(0, command.find_last_not_of(' ') + 1),
          .why = reason == std::string::npos ? "" : words.substr(reason + 3)};
}

}  // namespace plumb::offline

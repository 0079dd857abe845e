// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/json.hpp"

/// The answers of a running plumb-rt on its control socket: one line of JSON each.
namespace plumb::drivers::rt {

/// Bytes that are no UTF-8, as names of files may have them, are replaced: this never throws.
inline std::string reply(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

inline std::string refusal(const char* code, const std::string& message) {
  return reply({{"ok", false}, {"error", {{"code", code}, {"message", message}}}});
}

}  // namespace plumb::drivers::rt

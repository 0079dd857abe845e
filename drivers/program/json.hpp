// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "program/problem.hpp"

/// JSON output for other programs: units are part of the keys, and NaN never occurs.
namespace plumb {

using Json = nlohmann::ordered_json;

/// `value` under `key`; if it is not finite, null with "<key>_reason".
void put(Json& object, const std::string& key, double value,
         const std::string& reason = "not a finite number");

/// Writes null under `key` and the reason under "<key>_reason".
void put_null(Json& object, const std::string& key, const std::string& reason);

/// {severity, code, message, place, help}
Json problem_json(const Problem& problem);

/// One object, indented; invalid UTF-8 is replaced, so this never throws on file names.
std::string to_text(const Json& json);

}  // namespace plumb

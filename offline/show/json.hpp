// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cell/problem.hpp"
#include "fit/error_stats.hpp"
#include "plumb/format/model.hpp"

/// What programs read: units in key names, mm and deg, never NaN.
namespace plumb::offline::show {

using Json = nlohmann::ordered_json;

/// `value` under `key`; if it is not finite, null with "<key>_reason".
void put(Json& object, const std::string& key, double value,
         const std::string& reason = "not a finite number");

/// null under `key`, and why under "<key>_reason".
void put_null(Json& object, const std::string& key, const std::string& reason);

/// {n, mean_mm, rms_mm, p95_mm, max_mm}; null with reason if n == 0.
Json stats_json(const ErrorStats& stats);

/// {xyz_mm, quat_wxyz}
Json pose_json(const format::Pose& pose);

/// {severity, code, message, place, help}
Json problem_json(const Problem& problem);

/// One object, indented; invalid UTF-8 is replaced, so this never throws on file names.
std::string to_text(const Json& json);

}  // namespace plumb::offline::show

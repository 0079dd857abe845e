// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "noise/error_stats.hpp"
#include "program/json.hpp"

/// Parts that the JSON files of fits and fleets share. SI. Reading throws nlohmann::json::exception
/// if the content is of another form.
namespace plumb::offline {

inline Json to_json(const ErrorStats& s) {
  return {{"n", s.n}, {"mean_m", s.mean}, {"rms_m", s.rms}, {"p95_m", s.p95}, {"max_m", s.max}};
}
inline ErrorStats stats_from(const Json& j) {
  return {.n = j.at("n"),
          .mean = j.at("mean_m"),
          .rms = j.at("rms_m"),
          .p95 = j.at("p95_m"),
          .max = j.at("max_m")};
}

}  // namespace plumb::offline

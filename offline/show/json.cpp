// SPDX-License-Identifier: Apache-2.0
#include "show/json.hpp"

#include <cmath>

#include "show/units.hpp"

namespace plumb::offline::show {

void put(Json& object, const std::string& key, double value, const std::string& reason) {
  if (std::isfinite(value))
    object[key] = value;
  else
    put_null(object, key, reason);
}

void put_null(Json& object, const std::string& key, const std::string& reason) {
  object[key] = nullptr;
  object[key + "_reason"] = reason;
}

Json stats_json(const ErrorStats& stats) {
  Json out{{"n", stats.n}};
  const std::pair<const char*, double> figures[] = {
      {"mean_mm", stats.mean}, {"rms_mm", stats.rms}, {"p95_mm", stats.p95}, {"max_mm", stats.max}};
  for (const auto& [key, value] : figures) {
    if (stats.n == 0)
      put_null(out, key, "no pose belongs to this set");
    else
      put(out, key, to_mm(value));
  }
  return out;
}

Json pose_json(const format::Pose& pose) {
  return {{"xyz_mm", {to_mm(pose.p[0]), to_mm(pose.p[1]), to_mm(pose.p[2])}},
          {"quat_wxyz", pose.q}};
}

namespace {

Json place_json(const std::optional<Place>& place) {
  if (!place) return nullptr;
  return {{"file", place->file}, {"line", place->line}, {"column", place->column}};
}

const char* severity_name(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kNote:
      return "note";
  }
  return "error";
}

}  // namespace

Json problem_json(const Problem& problem) {
  return {{"severity", severity_name(problem.severity)},
          {"code", problem.code},
          {"message", problem.message},
          {"place", place_json(problem.place)},
          {"help", problem.help}};
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace plumb::offline::show

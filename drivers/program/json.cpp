// SPDX-License-Identifier: Apache-2.0
#include "program/json.hpp"

#include <cmath>

namespace plumb {
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

}  // namespace plumb

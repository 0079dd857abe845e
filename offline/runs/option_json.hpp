// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "effects/effect_entry.hpp"
#include "program/json.hpp"

/// The value of an effect's option, in JSON as in cell.toml.
template <>
struct nlohmann::adl_serializer<plumb::offline::EffectEntry::Value> {
  static void to_json(plumb::Json& j, const plumb::offline::EffectEntry::Value& value) {
    std::visit([&j](const auto& v) { j = v; }, value);
  }
  static void from_json(const plumb::Json& j, plumb::offline::EffectEntry::Value& value) {
    if (j.is_boolean())
      value = j.get<bool>();
    else if (j.is_string())
      value = j.get<std::string>();
    else if (j.is_array())
      value = j.get<std::vector<std::string>>();
    else
      value = j.get<double>();
  }
};

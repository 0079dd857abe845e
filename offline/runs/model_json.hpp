// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "plumb/format/model.hpp"

/// Model structs as JSON for the run store, in SI and with full precision: reading gives the same
/// bits.
namespace plumb::format {

void to_json(nlohmann::ordered_json& j, const Pose& pose);
void from_json(const nlohmann::ordered_json& j, Pose& pose);
void to_json(nlohmann::ordered_json& j, const Twist& twist);
void from_json(const nlohmann::ordered_json& j, Twist& twist);
void to_json(nlohmann::ordered_json& j, const JointRow& row);
void from_json(const nlohmann::ordered_json& j, JointRow& row);
void to_json(nlohmann::ordered_json& j, const Chain& chain);
void from_json(const nlohmann::ordered_json& j, Chain& chain);
void to_json(nlohmann::ordered_json& j, const Tree& tree);
void from_json(const nlohmann::ordered_json& j, Tree& tree);
void to_json(nlohmann::ordered_json& j, const Domain& domain);
void from_json(const nlohmann::ordered_json& j, Domain& domain);
void to_json(nlohmann::ordered_json& j, const Effect& effect);
void from_json(const nlohmann::ordered_json& j, Effect& effect);
void to_json(nlohmann::ordered_json& j, const Mechanics& mechanics);
void from_json(const nlohmann::ordered_json& j, Mechanics& mechanics);
void to_json(nlohmann::ordered_json& j, const InputHash& input);
void from_json(const nlohmann::ordered_json& j, InputHash& input);

}  // namespace plumb::format

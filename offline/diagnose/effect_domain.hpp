// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace plumb::offline {

/// What an effect belongs to: "robot", "environment", "procedure" or "measurement".
std::string domain_word(const EffectEntry& entry);

/// Whether effects of that law become part of the model file: those of the robot and, as far as
/// their input is known online, of the environment.
bool is_compiled(const EffectEntry& entry);

}  // namespace plumb::offline

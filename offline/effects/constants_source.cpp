// SPDX-License-Identifier: Apache-2.0
#include "effects/constants_source.hpp"

#include <fmt/format.h>

namespace plumb::offline {

void refuse_effect(const EffectEntry& entry, const std::string& why, const std::string& help) {
  throw Failure(Exit::kInput, {.code = "E-EFFECT-DATA",
                               .message = fmt::format("effect '{}' {}", entry.name, why),
                               .place = entry.place,
                               .help = help});
}

}  // namespace plumb::offline

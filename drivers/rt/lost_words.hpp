// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/session_inputs.hpp"

namespace plumb::drivers::rt {

/// The word of every input in the set, in the order of their bits.
std::vector<const char*> lost_words(Lost set);

/// "registers 1200 to 1215: exception 2, illegal data address"; empty if nothing is refused.
std::string refusal_text(const WriteRefusal& refusal);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/drivers/session_inputs.hpp"

namespace plumb::drivers::rt {

/// The word of every input in the set, in the order of their bits.
std::vector<const char*> lost_words(Lost set);

}  // namespace plumb::drivers::rt

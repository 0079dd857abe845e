// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/imported.hpp"

namespace plumb::offline {

/// Adds dir_jN and travel_jN of consecutive moves.
void add_directions(Imported& data);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/format/model.hpp"

namespace plumb::format {

/// A sound model with every field away from its default, the same for the same seed.
Model random_model(std::uint64_t seed);

/// A sound model at every bound of limits.hpp at once.
Model largest_model();

}  // namespace plumb::format

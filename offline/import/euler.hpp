// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "cell/euler.hpp"

namespace plumb::offline {

/// The convention that --rot names. Throws Failure (kUsage, E-IMPORT-ROT) for one it does not know.
EulerConvention euler_convention(std::string_view name);

}  // namespace plumb::offline

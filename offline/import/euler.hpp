// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cell/euler.hpp"
#include "import/imported.hpp"

namespace plumb::offline {

/// The convention that --rot names. Throws Failure (kUsage, E-IMPORT-ROT) for one it does not know.
EulerConvention euler_convention(std::string_view name);

/// rx, ry, rz mean nothing without the order of the turns.
void turn_to_quaternions(const std::string& order, Imported& data);

}  // namespace plumb::offline

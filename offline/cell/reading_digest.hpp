// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Tells a reading from others wherever it is kept: 16 hexadecimal digits of the SHA-256 sum of its
/// joint angles and its measured point, bit by bit.
std::string reading_digest(const Measurements& measured, int row);

}  // namespace plumb::offline

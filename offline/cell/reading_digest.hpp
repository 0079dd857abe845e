// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_set>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Tells a reading from others in whatever units it is kept: 16 hexadecimal digits of the SHA-256
/// sum of its joint angles, to 10 urad or 10 um, and of its measured point, to 10 um.
std::string reading_digest(const Measurements& measured, int row);
std::unordered_set<std::string> reading_digests(const Measurements& measured);

/// How many of these readings are among the known ones. A point that is measured twice may by
/// chance be the same to 10 um.
int count_known(const Measurements& measured, const std::unordered_set<std::string>& known);

}  // namespace plumb::offline

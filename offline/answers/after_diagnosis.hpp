// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// The commands to type next, without `plumb`; the first helps most. The reason may follow a
/// command behind " # ".
std::vector<std::string> after_diagnosis(const Cell& cell, const Diagnosis& diagnosis);

}  // namespace plumb::offline

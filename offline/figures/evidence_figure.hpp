// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "diagnose/diagnosis.hpp"

namespace plumb::offline::figures {

/// The effects that may be missing, the most probable first: the fall of the error with its
/// standard error, the evidence, the held-out error alone and together with the first. One SVG
/// file, `width` px wide (320 to 4000).
std::string evidence(const Cell& cell, const Diagnosis& diagnosis, double width);

}  // namespace plumb::offline::figures

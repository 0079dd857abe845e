// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// A direction of gravity as cell.toml writes it: "[0, 0, -9.81]".
std::string gravity_text(const std::array<double, 3>& gravity);

/// The finding at the start, and with `apply` at the end, each in one sentence.
std::string verdict_text(const Cell& cell, const Diagnosis& diagnosis);
std::string verdict_after_text(const Cell& cell, const Diagnosis& diagnosis);

}  // namespace plumb::offline

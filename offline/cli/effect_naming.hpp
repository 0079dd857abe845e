// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace plumb::offline::cli {

/// Throws Failure (kUsage, `code`) with "did you mean" if there is no such effect.
void require_effect(const std::string& name, const char* code);

/// The joint of that name, zero-based. Throws Failure (kUsage, `code`) if there is none.
int joint_named(const Cell& cell, const std::string& name, const char* code);

}  // namespace plumb::offline::cli

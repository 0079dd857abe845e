// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace plumb::offline::cli {

/// CSV with `count` targets of the nominal arm, well inside its joint limits and away from
/// singular poses, each with the joint state to start from; commanded joints beyond six.
/// The same cell gives the same text.
std::string demo_targets(const Cell& cell, int count);

}  // namespace plumb::offline::cli

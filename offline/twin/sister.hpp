// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "twin/twin_file.hpp"

namespace plumb::offline::twin {

/// The truth of another arm of the same type and batch. Nominal values, noise and kinds of effects
/// are the same; its errors of geometry are in part those of the first arm and in part its own, the
/// sizes of its effects differ by a tenth (1 sigma). It has a tracker and a reflector of its own.
HiddenTruth sister_of(const Cell& cell, const Hidden& hidden, std::uint64_t number);

/// The cell of that arm, measured into this file: the cell of its sister with another serial
/// number.
Cell cell_of_sister(Cell cell, std::uint64_t number, const std::filesystem::path& measurements);

}  // namespace plumb::offline::twin

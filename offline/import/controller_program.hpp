// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// The joint positions in a program of a controller (N-IMPORT-PROGRAM): Fanuc TP (LS), ABB RAPID,
/// KUKA KRL, Universal Robots script. Nothing if the text is no program. Throws Failure (kInput,
/// E-IMPORT-PROGRAM) for a program without joint positions, and for one in pulses.
std::optional<RawRows> controller_program(const SourceText& text);

}  // namespace plumb::offline

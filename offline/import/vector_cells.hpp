// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "import/dialect.hpp"

namespace plumb::offline {

/// Several numbers in one cell, between brackets: "[0.1, 0.2, 0.3]".
bool is_vector(std::string_view cell);

/// Makes a column of vectors into as many columns: "joints" into "joint 1", "joint 2", ...,
/// "position [m]" into "position x [m]", ... (N-IMPORT-VECTOR).
void expand_vectors(const SourceText& text, RawRows& rows);

}  // namespace plumb::offline

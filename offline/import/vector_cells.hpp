// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// Makes a column of vectors into as many columns: "joints" into "joint 1", "joint 2", ...,
/// "position [m]" into "position x [m]", ... (N-IMPORT-VECTOR).
void expand_vectors(const SourceText& text, RawRows& rows);

}  // namespace plumb::offline

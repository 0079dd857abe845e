// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// Rows of lines that name every number, "X= 729.06 Y= -1748.77" or {"x": 729.06, "y": -1748.77}
/// (N-IMPORT-PAIRS). Nothing if most lines are written otherwise.
std::optional<RawRows> key_values(const SourceText& text);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// Units that stand in the cells, "729.06 mm" or 54°49'46", become the unit of their column
/// (N-IMPORT-CELLS). Throws Failure (kInput, E-IMPORT-CELLS) if the cells of a column have
/// different units, or another one than the heading says.
void take_units_from_cells(const SourceText& text, RawRows& rows);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// Refuses a table of one column a pose (kInput, E-IMPORT-TRANSPOSED): one row a pose is needed.
void refuse_transposed(const SourceText& text, const RawRows& rows);

}  // namespace plumb::offline

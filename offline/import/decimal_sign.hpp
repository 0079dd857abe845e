// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// '.' or ',', as the cells of all rows tell. Throws Failure (kInput, E-IMPORT-DECIMAL) if a sign
/// may divide thousands or decimals.
char find_decimal(const SourceText& text, const RawRows& rows);

}  // namespace plumb::offline

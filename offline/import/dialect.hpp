// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/raw_rows.hpp"
#include "import/source_text.hpp"

namespace plumb::offline {

/// What the user states about a file; the rest is detected.
struct DialectWishes {
  std::optional<char> separator;  // ' ' stands for any run of blanks
  std::optional<char> decimal;    // '.' or ','
  std::vector<std::string> header;
};

/// Finds separator, decimal sign, header and units, and cuts every row. Throws Failure (kInput):
/// E-IMPORT-HEADER (none, or none found), E-IMPORT-DECIMAL (a sign that may divide thousands or
/// decimals), E-IMPORT-ROWS (a header and nothing else).
RawRows cut(const SourceText& text, const DialectWishes& wishes);

}  // namespace plumb::offline

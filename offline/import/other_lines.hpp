// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/raw_rows.hpp"

namespace plumb::offline {

/// Leaves out the lines that are no measurements, and names them: headers and units that stand
/// again between the rows, lines of text or of signs (N-IMPORT-LINES), and means, deviations and
/// extremes below the rows (N-IMPORT-STATISTICS).
void leave_out_other_lines(const SourceText& text, RawRows& rows);

/// "lines 3, 7 and 9"; "lines 3 to 9"; ten at most.
std::string lines_in_words(const std::vector<int>& lines);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "import/cell_table.hpp"
#include "import/source_text.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// The names of the columns of a table without header, if its cells tell them: points of
/// SpatialAnalyzer, "A::robot::p1 x y z", and joint states of ROS (N-IMPORT-NAMED). Else throws
/// Failure (kInput, E-IMPORT-HEADER) that proposes a --header.
std::vector<std::string> names_without_header(const SourceText& text, int line,
                                              const CellTable& rows, std::vector<Problem>& remarks);

}  // namespace plumb::offline

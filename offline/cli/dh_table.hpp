// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cell/table.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline::cli {

/// Reads the text of a DH table: names and units of columns as people write them (read_dh_heading),
/// numbers too (read_dh_value). Every row is a joint, so that none may be left out. A column that
/// no DH table has keeps its heading as its name. Columns in file order, numbers in SI, NaN for
/// empty cells of limits and offset. What is wrong goes to `problems`, all of it in one pass; a
/// text that is no table (YAML, JSON, XML, a spreadsheet) is named as such.
Table parse_dh_table(std::string_view text, const std::string& file, ProblemList& problems);

}  // namespace plumb::offline::cli

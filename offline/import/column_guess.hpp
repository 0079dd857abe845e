// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumb::offline {

/// What a foreign column becomes.
struct ColumnPlan {
  std::string from;       // as in the file
  std::string name = {};  // canonical, without unit: "q1", "x", "temp", "pose"; empty: left out
  std::string unit = {};  // of the file's numbers: "rad"; empty for texts and plain numbers
  bool wished = false;    // by --map
  bool lacks_unit = false;
  std::string foreign = {};  // a unit that plumb does not convert: "cm"
};

/// Plans a column: "X [mm]", "x(mm)", "Joint 1 / deg", "A1", "axis_3 deg", "Temp °C" are known; a
/// unit row helps. What is not recognised is left out.
ColumnPlan guess_column(const std::string& header, const std::string& unit_row);

/// "Goal x=nx_m" or "note=-": the column and what it becomes.
struct ColumnWish {
  std::string from, to;
};

/// The plan of every column. Throws Failure (kUsage): E-IMPORT-MAP for a column that is not there
/// (did you mean) or a new name without a known unit, E-IMPORT-TWICE for two of one name.
std::vector<ColumnPlan> plan_columns(const std::vector<std::string>& header,
                                     const std::vector<std::string>& units,
                                     const std::vector<std::string>& wishes);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "import/column_plan.hpp"
#include "import/content.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Plans a column: "X [mm]", "x(mm)", "Joint 1 / deg", "Achse_3 deg", "Temp °C" are known; a unit
/// row helps. What is not recognised is left out.
ColumnPlan guess_column(const std::string& header, const std::string& unit_row);

/// "Goal x=nx_m" or "note=-": the column and what it becomes.
struct ColumnWish {
  std::string from, to;
};

/// The requests of --map, several in one text: "x=x_mm,Y, measured=y_mm". `columns`: names in the
/// files, which may hold commas. Throws Failure (kUsage, E-IMPORT-MAP).
std::vector<ColumnWish> wishes_of(const std::vector<std::string>& texts,
                                  const std::vector<std::string>& columns);

/// The plan of every column. `elsewhere`: columns of the other file, which wishes may also name;
/// `joints`: the names of the joints of the cell, if there is one.
/// Throws Failure (kUsage): E-IMPORT-MAP for a column that is in no file (did you mean) or a new
/// name without a known unit, E-IMPORT-TWICE for two columns that would get the same name.
std::vector<ColumnPlan> plan_columns(const std::vector<std::string>& header,
                                     const std::vector<std::string>& units,
                                     const std::vector<ColumnContent>& contents,
                                     const std::vector<ColumnWish>& wishes,
                                     const std::vector<std::string>& elsewhere,
                                     const std::vector<std::string>& joints,
                                     std::vector<Problem>& remarks);

}  // namespace plumb::offline

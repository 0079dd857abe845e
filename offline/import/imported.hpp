// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "import/cell_column.hpp"
#include "program/outcome.hpp"

namespace plumb::offline {

/// One column on its way into measurements.csv: numbers keep the digits they came with.
struct ImportedColumn {
  std::string from;  // what it was called; "" if derived
  std::string name;  // canonical, without unit
  std::string unit;
  CellColumn text;  // decimal point; as it will be written

  std::string heading() const { return unit.empty() ? name : name + "_" + unit; }
};

/// Its numbers in SI; as they are if they have no unit.
std::vector<double> si_values(const ImportedColumn& column);

/// A column of numbers that is not used.
struct UnusedColumn {
  std::string from;
  double largest = 0.0;  // largest absolute value, as written
};

/// A foreign file as plumb understood it.
struct Imported {
  std::string file;
  std::vector<InputFile> inputs;   // what was read for it
  std::string separator, decimal;  // in words
  std::vector<ImportedColumn> columns;
  std::vector<std::string> left_out;
  std::vector<UnusedColumn> unused;  // without those that the user left out
  std::string start;                 // what t counts from: "date", "clock"; else not known
  double start_s = 0.0;              // of that: seconds since 1970, or of the day
  std::vector<int> lines;            // line number of each row
  std::vector<std::pair<std::string, std::string>> comments;
  std::vector<Problem> remarks;

  int rows() const { return static_cast<int>(lines.size()); }
  const ImportedColumn* find(const std::string& name) const {
    for (const auto& column : columns)
      if (column.name == name) return &column;
    return nullptr;
  }
};

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/kept_rows.hpp"
#include "cell/quantity.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// One column of a measurement file.
struct Column {
  std::string header;  // as written: "q1_deg"
  std::string name;    // without the unit: "q1"
  std::string unit;    // "deg"; empty for text and plain numbers
  Quantity quantity = Quantity::kText;
  std::vector<double> values;     // SI, temperatures in [degC]; empty for text columns
  std::vector<std::string> text;  // for text columns
};

/// A measurement file as read: columns in file order, all of one length, numbers in SI.
struct Table {
  std::string file;
  std::string sha256;
  std::vector<std::pair<std::string, std::string>> comments;  // "# key: value"
  std::vector<Column> columns;
  std::vector<int> lines;  // source line of each row
  KeptRows raw_rows;       // as written, but with commas and decimal points, for copying
  std::string raw_header;
  int header_line = 0;  // source line of the header
  std::vector<Problem> remarks;
  int rows() const { return static_cast<int>(lines.size()); }
  const Column* find(std::string_view name) const;
  const Column* find_text(std::string_view name) const;  // null if it holds numbers
};

/// Index of the table of each row, if the tables are joined: 0, ..., 0, 1, ...
std::vector<int> file_of_rows(const std::vector<Table>& tables);

}  // namespace plumb::offline

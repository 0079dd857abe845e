// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/csv_header.hpp"
#include "cell/csv_number.hpp"
#include "cell/units.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {

/// Reads the lines of a CSV file into a table, as many at a time as one likes. What is wrong is
/// collected in `problems`; only bytes that are no text end it at once (Failure, check_bytes).
///
/// Once the header is read, `below` makes readers of the rows further down, so that blocks of a
/// file can be read side by side.
class TableReader {
 public:
  explicit TableReader(std::string file);

  /// A reader of the lines from `first_line` on: it knows header and comments, and has no rows yet.
  TableReader below(int first_line) const;

  /// Reserves memory for what will be read.
  void expect(std::size_t rows, std::size_t bytes);

  /// Reads whole lines, those that follow the ones read before.
  void read(std::string_view lines);

  bool has_header() const { return !table_.columns.empty(); }
  int rows() const { return table_.rows(); }
  ProblemList& problems() { return problems_; }

  /// A number of these rows has a decimal comma.
  bool has_decimal_comma() const { return commas_; }

  /// N-CSV-SEMICOLON, if columns are separated by it.
  std::optional<Problem> separator_note(bool decimal_comma) const;

  /// E-CSV-TEXT in place of E-CSV-UNIT for a column without unit whose cells hold texts: no unit
  /// helps it. To be called when its rows are read.
  void check_texts();

  /// The same, and reports as problems that there is no header or no row, unless there are problems
  /// already.
  void check_content();

  /// The rows, and the remarks of `problems`.
  Table take();

 private:
  /// One problem of the header in place of one for each row, if no row has as many cells as it.
  void blame_header();
  void read_line(std::string_view line);
  void read_comment(std::string_view line);
  void read_header_line(std::string_view line);
  void reserve();
  bool cut(std::string_view line);
  void read_row(std::string_view line);
  void ragged(std::string_view line);
  void read_cell(std::size_t i, std::string_view line);
  void bad_cell(std::size_t i, std::string_view line, NumberFault fault);
  void append_canonical(std::string_view line);
  CsvPlace here(std::string_view line) const { return {table_.file, line_number_, line}; }

  Table table_;
  ProblemList problems_;
  std::vector<CsvCell> cells_;
  std::vector<Unit> units_;
  std::string kept_;
  std::vector<std::size_t> begins_, sizes_;
  std::size_t expected_rows_ = 0, expected_bytes_ = 0;
  char separator_ = ',';
  Place semicolon_;      // the first one of the header
  bool commas_ = false;  // in a number
  int line_number_ = 0;
};

}  // namespace plumb::offline

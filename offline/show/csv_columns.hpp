// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline::show {

/// Measurement files passed through, with columns that plumb adds behind theirs ("ours").
///
/// Input cells stay as written. Several tables are stacked; a column that one of them lacks is
/// empty there. A column of ours takes the place of an input column of the same name.
class CsvColumns {
 public:
  explicit CsvColumns(const std::vector<offline::Table>& tables);

  int rows() const { return rows_; }

  /// Shape of `cells`: (rows,).
  void set(const std::string& name, std::vector<std::string> cells);
  void set(const std::string& name, const std::vector<double>& values);

  /// Input columns that `set` replaced.
  const std::vector<std::string>& replaced() const { return replaced_; }

  std::string text() const;

 private:
  std::size_t column(const std::string& name);

  struct Part {
    std::vector<std::size_t> columns;  // the output column of each of its columns
    KeptRows rows;
  };
  void append(const Part& part, std::size_t row, std::size_t row_of_all, std::string& out) const;

  std::vector<std::string> header_;
  std::vector<Part> parts_;  // one for each table
  int rows_ = 0;
  std::size_t inputs_ = 0;
  std::vector<std::vector<std::string>> ours_;  // cells of each column; empty for input columns
  std::vector<std::string> replaced_;
};

}  // namespace plumb::offline::show

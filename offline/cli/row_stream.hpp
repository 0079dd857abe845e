// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cell/measurements.hpp"
#include "cli/csv_output.hpp"
#include "program/outcome.hpp"
#include "program/spool.hpp"
#include "show/pass_through.hpp"

namespace plumb::offline::cli {

/// The cells that plumb adds to one row: numbers as their shortest text.
class RowCells {
 public:
  void clear() { count_ = used_ = 0; }
  void add(double value);
  void add(const char* text);  // must outlive this object
  std::span<const std::string_view> cells() const { return std::span(cells_).first(count_); }

 private:
  static constexpr std::size_t kMost = 12, kLongest = 32;  // cells of a row; characters of a number
  std::array<char, kMost * kLongest> text_;
  std::array<std::string_view, kMost> cells_;
  std::size_t count_ = 0, used_ = 0;
};

/// A CSV file of any length, read, computed and written a block of rows at a time: columns of ours
/// stand behind those of the input. Blocks are worked on side by side and written in order. Memory:
/// some blocks of a megabyte.
///
/// All problems of the file are found in one pass and thrown as one Failure (kInput), as
/// read_table does; nothing is written then. One bad row of a long file costs the whole pass.
class RowStream {
 public:
  /// What was made of a block: what is to be said of its columns, and what writes its rows.
  struct Computed {
    std::vector<Problem> remarks;
    std::function<void(std::string&)> append;  // in the order of the file, by one thread
  };

  /// Computes one block; is called from several threads. Throws Failure with what is wrong with the
  /// rows.
  using Work = std::function<Computed(Table, const show::PassThrough&)>;

  /// Throws Failure (kUsage) if the output may not be written, for example because it is the file
  /// that is read.
  RowStream(std::filesystem::path file, std::vector<std::string> columns, const CsvOutput& output,
            Outcome& outcome);

  /// Reads and computes everything. File and remarks go to `outcome`.
  void run(const Work& work, Outcome& outcome);

  /// Gives the output its name. `summary`: for people, if they do not see the rows instead.
  void deliver(const std::string& summary, Outcome& outcome);

 private:
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  const CsvOutput& output_;
  Spool spool_;
};

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plumb/runtime/status.hpp"
#include "program/outcome.hpp"
#include "program/output_files.hpp"
#include "program/spool.hpp"
#include "show/csv_columns.hpp"

namespace plumb::offline::cli {

/// -o of the verbs that make a CSV file; without it the file goes to stdout.
struct CsvOutput {
  std::string file;
  WriteOptions write;
  void add_to(VerbOptions& verb);
};

/// Refuses --json and --dry-run without -o.
void check_output(const CsvOutput& output, const Globals& globals);

/// Refuses to replace a file without --force (E-EXISTS), or one that belongs to what the verb works
/// on (E-OUTPUT-INPUT).
void refuse_existing(const CsvOutput& output, const Outcome& outcome);

/// N-CSV-REPLACED of each of these columns.
std::vector<Problem> replaced_notes(const std::vector<std::string>& columns);

/// Writes the file, or makes it the text of the outcome. `summary`: for people, after writing.
void deliver(const show::CsvColumns& columns, const CsvOutput& output, const std::string& summary,
             Outcome& outcome);

/// Gives what was spooled its name, unless nothing is to be written; the result tells the file.
void deliver(Spool& spool, const CsvOutput& output, Outcome& outcome);

/// Rows of each status, in the order of the numbers: ok comes before what is wrong.
class StatusCounts {
 public:
  void add(Status status, std::size_t rows = 1);
  void add(const StatusCounts& more);

  std::size_t rows() const;
  std::size_t refused_rows() const;
  std::size_t of(Status status) const;
  const std::map<int, std::pair<Status, std::size_t>>& all() const { return counts_; }

 private:
  std::map<int, std::pair<Status, std::size_t>> counts_;
};

/// {status: rows}, and the same for people.
Json to_json(const StatusCounts& counts);
std::string status_summary(const StatusCounts& counts);

}  // namespace plumb::offline::cli

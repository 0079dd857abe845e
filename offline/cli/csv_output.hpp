// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/runtime/status.hpp"
#include "program/outcome.hpp"
#include "program/output_files.hpp"
#include "show/csv_columns.hpp"

namespace plumb::offline::cli {

/// -o of the verbs that make a CSV file; without it the file goes to stdout.
struct CsvOutput {
  std::string file;
  WriteOptions write;
  void add_to(CLI::App& verb);
};

/// Refuses --json and --dry-run without -o.
void check_output(const CsvOutput& output, const Globals& globals);

/// Writes the file, or makes it the text of the outcome. `summary`: for people, after writing.
void deliver(const show::CsvColumns& columns, const CsvOutput& output, const std::string& summary,
             Outcome& outcome);

/// Status column of a row, and {status: rows} over all.
std::vector<std::string> status_texts(const std::vector<Status>& status);
Json status_counts(const std::vector<Status>& status);
std::string status_summary(const std::vector<Status>& status);

}  // namespace plumb::offline::cli

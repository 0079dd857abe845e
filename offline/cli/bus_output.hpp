// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "program/output_files.hpp"

namespace plumb::offline::cli {

/// -o, --force and --dry-run of the verbs that print the bus layout for other tools.
struct BusOutput {
  std::string file;
  WriteOptions write;
  void add_to(VerbOptions& verb);
};

/// "Drilling cell 4 (F08-1234)"
std::string about(const Cell& cell);

/// The text to -o with `headline` on stdout, or the text itself to stdout; in JSON as `key`.
void put_out(const BusOutput& output, const std::string& key, const std::string& text,
             const std::string& headline, Outcome& outcome);

}  // namespace plumb::offline::cli

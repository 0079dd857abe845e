// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "import/dialect.hpp"
#include "import/imported.hpp"

namespace plumb::offline {

/// What the user says of the files; the rest is found out and told.
struct ImportWishes {
  DialectWishes dialect;
  std::vector<std::string> map;  // "Goal x=nx_m"
  std::string rotation;          // "xyz-moving": what rx, ry, rz mean
  bool preview = false;          // a column without unit is a warning, its unit "?"
};

/// Reads one foreign file: encoding, dialect, columns, time stamps, turns. Throws Failure with all
/// bad cells (first 20).
Imported import_file(const std::filesystem::path& file, const ImportWishes& wishes);

/// Adds dir_jN and travel_jN of consecutive moves.
void add_directions(Imported& data);

/// measurements.csv: comments, header with units, rows; read_table of it succeeds.
std::string imported_csv(const Imported& data);

}  // namespace plumb::offline

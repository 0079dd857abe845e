// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "import/dialect.hpp"
#include "import/imported.hpp"
#include "import/timestamps.hpp"

namespace plumb::offline {

/// What the user states about the files; the rest is detected and reported.
struct ImportWishes {
  DialectWishes dialect;
  std::vector<std::string> map;  // "Goal x=nx_m"
  std::string rotation;          // "xyz-moving": what rx, ry, rz mean
  DateOrder date_order = DateOrder::kUnknown;
  bool skip_bad = false;               // rows with a cell that is no number are left out
  bool preview = false;                // a column without unit is a warning, its unit "?"
  std::vector<std::string> elsewhere;  // columns of the other file, which `map` may also name
  std::vector<std::string> joints;     // names of the cell's joints, from base to tip
};

/// Reads one foreign file: encoding, dialect, columns, time stamps, turns. Throws Failure with all
/// bad cells (first 20).
Imported import_file(const std::filesystem::path& file, const ImportWishes& wishes);

/// The names of the columns of a file. Throws as `import_file`.
std::vector<std::string> column_names(const std::filesystem::path& file,
                                      const DialectWishes& wishes);

}  // namespace plumb::offline

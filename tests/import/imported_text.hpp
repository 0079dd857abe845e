// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "cell/table.hpp"
#include "cell/table_file.hpp"
#include "import/imported_csv.hpp"
#include "import/importer.hpp"
#include "import/timestamps.hpp"
#include "tests/import/temporary_file.hpp"

namespace plumb::tests {

inline offline::Imported imported_text(const std::string& bytes,
                                       const offline::ImportWishes& wishes = {}) {
  const TemporaryFolder folder;
  return offline::import_file(folder.put("log.txt", bytes), wishes);
}

/// The first problem for which a text is refused; without code if it is accepted.
inline Problem refusal_of(const std::string& bytes, const offline::ImportWishes& wishes = {}) {
  try {
    (void)imported_text(bytes, wishes);
  } catch (const Failure& f) {
    return f.problems().front();
  }
  return {};
}

inline std::vector<std::string> texts_of(const offline::ImportedColumn& column) {
  return {column.text.begin(), column.text.end()};
}

inline offline::Timestamps timestamps_in(const std::vector<std::string_view>& cells, char decimal,
                                         offline::DateOrder order = offline::DateOrder::kUnknown) {
  offline::CellColumn column;
  for (const auto cell : cells) column.add(cell);
  return offline::read_timestamps(column, decimal, order);
}

/// measurements.csv as plumb reads it.
inline offline::Table table_of(const offline::Imported& data) {
  std::string csv;
  offline::write_imported(data, [&](std::string_view block) { csv += block; });
  return offline::parse_table(csv, "imported");
}

/// "q1_deg=1|2 x_mm=3|4": the columns and their cells.
inline std::string in_short(const offline::Imported& data) {
  std::string out;
  for (const auto& column : data.columns) {
    out += (out.empty() ? "" : " ") + column.heading() + "=";
    for (std::size_t i = 0; i < column.text.size(); ++i)
      out += (i > 0 ? "|" : "") + std::string(column.text[i]);
  }
  return out;
}

/// The message of the first remark of this code; empty if there is none.
inline std::string remark_of(const offline::Imported& data, const std::string& code) {
  const auto at = std::find_if(data.remarks.begin(), data.remarks.end(),
                               [&](const Problem& p) { return p.code == code; });
  return at == data.remarks.end() ? "" : at->message;
}

}  // namespace plumb::tests

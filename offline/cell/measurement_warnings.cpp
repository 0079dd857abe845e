// SPDX-License-Identifier: Apache-2.0
#include "cell/measurement_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

#include "cell/column_names.hpp"
#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

constexpr double kSamePose = 0.02;  // [rad] or [m]: more is another pose under the same name

std::string count_of(int doubles) {
  return doubles == 1 ? "a row is" : fmt::format("{} rows are", doubles);
}

void warn_of_name(Table& table, int row, const std::string& pose) {
  const Column* column = table.find("pose");
  if (column == nullptr) return;
  table.remarks.push_back({Severity::kWarning, "W-CSV-POSE",
                           fmt::format("pose '{}' names different joint positions", pose),
                           place_in_row(table, row, *column, "not where it was before"),
                           "give every pose its own name; rows of one name count as repeats"});
}

}  // namespace

void warn_of_misspelt(Table& table) {
  for (const auto& column : table.columns) {
    const auto meant = misspelt(column.name, column.quantity);
    if (!meant || table.find(*meant) != nullptr) continue;
    const std::string name = *meant + "_" + column.unit;
    table.remarks.push_back(
        {Severity::kWarning, "W-CSV-COLUMN",
         fmt::format("column '{}' is not known, so nothing reads it", column.header),
         place_in_header(table, column, fmt::format("did you mean '{}'?", name)),
         fmt::format("rename it to '{}' if it is meant", name)});
  }
}

void warn_of_doubles(Table& table) {
  std::vector<std::pair<std::size_t, int>> hashes(table.rows());
  for (int row = 0; row < table.rows(); ++row)
    hashes[row] = {std::hash<std::string_view>{}(table.raw_rows.view(row)), row};
  std::sort(hashes.begin(), hashes.end());
  int doubles = 0, first = table.rows(), original = 0;
  for (std::size_t k = 1; k < hashes.size(); ++k) {
    const int row = hashes[k].second, before = hashes[k - 1].second;
    if (hashes[k].first != hashes[k - 1].first) continue;
    if (table.raw_rows.view(row) != table.raw_rows.view(before)) continue;
    ++doubles;
    if (row > first) continue;
    first = row;
    original = before;
  }
  if (doubles == 0) return;
  table.remarks.push_back({Severity::kWarning, "W-CSV-DOUBLE",
                           fmt::format("{} identical to an earlier one", count_of(doubles)),
                           place_in_row(table, first, table.columns.front(),
                                        fmt::format("the same as line {}", table.lines[original])),
                           "delete the copy; a true repeat has its own reading"});
}

void warn_of_names(Measurements& m) {
  std::vector<int> first_of_group(m.size(), -1);
  int i = 0;
  for (auto& table : m.tables) {
    bool warned = false;
    for (int row = 0; row < table.rows(); ++row, ++i) {
      int& first = first_of_group[m.replicate_group[i]];
      if (first < 0) first = i;
      if (warned || m.q.cols() == 0) continue;
      warned = (m.q.row(i) - m.q.row(first)).cwiseAbs().maxCoeff() > kSamePose;
      if (warned) warn_of_name(table, row, m.pose[i]);
    }
  }
}

}  // namespace plumb::offline

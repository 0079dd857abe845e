// SPDX-License-Identifier: Apache-2.0
#include "show/csv_columns.hpp"

#include <algorithm>

#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

/// Cells of a row as written, quotes kept.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (char c : row) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

std::string joined(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t k = 0; k < cells.size(); ++k) out += (k == 0 ? "" : ",") + cells[k];
  return out + "\n";
}

}  // namespace

CsvColumns::CsvColumns(const std::vector<Table>& tables) {
  for (const auto& table : tables)
    for (const auto& name : cells_of(table.raw_header)) column(name);
  for (const auto& table : tables) {
    const auto names = cells_of(table.raw_header);
    for (const auto& raw : table.raw_rows) {
      const auto cells = cells_of(raw);
      auto& row = rows_.emplace_back(header_.size());
      for (std::size_t k = 0; k < std::min(cells.size(), names.size()); ++k)
        row[column(names[k])] = cells[k];
    }
  }
  inputs_ = header_.size();
}

std::size_t CsvColumns::column(const std::string& name) {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found != header_.end()) return static_cast<std::size_t>(found - header_.begin());
  header_.push_back(name);
  for (auto& row : rows_) row.emplace_back();
  return header_.size() - 1;
}

void CsvColumns::set(const std::string& name, std::vector<std::string> cells) {
  const std::size_t k = column(name);
  if (k < inputs_) replaced_.push_back(name);
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i][k] = std::move(cells[i]);
}

void CsvColumns::set(const std::string& name, const std::vector<double>& values) {
  std::vector<std::string> cells;
  cells.reserve(values.size());
  for (double value : values) cells.push_back(shortest(value));
  set(name, std::move(cells));
}

std::string CsvColumns::text() const {
  std::string out = joined(header_);
  for (const auto& row : rows_) out += joined(row);
  return out;
}

}  // namespace plumb::offline::show

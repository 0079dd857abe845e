// SPDX-License-Identifier: Apache-2.0
#include "show/csv_columns.hpp"

#include <algorithm>

#include "show/pass_through.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {

CsvColumns::CsvColumns(const std::vector<offline::Table>& tables) {
  std::vector<std::string_view> names;
  for (const auto& table : tables) {
    split_raw(table.raw_header, names);
    auto& part = parts_.emplace_back();
    for (const auto name : names) part.columns.push_back(column(std::string(name)));
    part.rows = table.raw_rows;
    rows_ += static_cast<int>(part.rows.size());
  }
  inputs_ = header_.size();
}

std::size_t CsvColumns::column(const std::string& name) {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found != header_.end()) return static_cast<std::size_t>(found - header_.begin());
  header_.push_back(name);
  ours_.emplace_back();
  return header_.size() - 1;
}

void CsvColumns::set(const std::string& name, std::vector<std::string> cells) {
  const std::size_t k = column(name);
  if (k < inputs_) replaced_.push_back(name);
  ours_[k] = std::move(cells);
}

void CsvColumns::set(const std::string& name, const std::vector<double>& values) {
  std::vector<std::string> cells;
  cells.reserve(values.size());
  for (double value : values) cells.push_back(shortest(value));
  set(name, std::move(cells));
}

void CsvColumns::append(const Part& part, std::size_t row, std::size_t row_of_all,
                        std::string& out) const {
  std::vector<std::string_view> read, cells(header_.size());
  split_raw(part.rows.view(row), read);
  for (std::size_t k = 0; k < std::min(read.size(), part.columns.size()); ++k)
    cells[part.columns[k]] = read[k];
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) out += ',';
    out += ours_[k].empty() ? cells[k] : std::string_view(ours_[k][row_of_all]);
  }
  out += '\n';
}

std::string CsvColumns::text() const {
  std::string out;
  for (std::size_t k = 0; k < header_.size(); ++k) out += (k == 0 ? "" : ",") + header_[k];
  out += '\n';
  std::size_t row_of_all = 0;
  for (const auto& part : parts_)
    for (std::size_t row = 0; row < part.rows.size(); ++row) append(part, row, row_of_all++, out);
  return out;
}

}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "cell/measurements.hpp"

namespace plumb::offline {
namespace {

template <class Matrix>
Matrix picked(const Matrix& all, const std::vector<int>& rows) {
  if (all.rows() == 0) return all;
  return all(rows, Eigen::all);
}

template <class Value>
std::vector<Value> picked(const std::vector<Value>& all, const std::vector<int>& rows) {
  std::vector<Value> out;
  if (all.empty()) return out;
  out.reserve(rows.size());
  for (const int row : rows) out.push_back(all[row]);
  return out;
}

Table picked(const Table& all, const std::vector<int>& rows) {
  Table out;
  out.file = all.file;
  out.sha256 = all.sha256;
  out.comments = all.comments;
  for (const auto& column : all.columns) {
    Column some{column.header, column.name, column.unit, column.quantity, {}, {}};
    some.values = picked(column.values, rows);
    some.text = picked(column.text, rows);
    out.columns.push_back(std::move(some));
  }
  out.lines = picked(all.lines, rows);
  out.raw_rows = all.raw_rows.pick(rows);
  out.raw_header = all.raw_header;
  out.header_line = all.header_line;
  return out;
}

/// Each run of rows from one file becomes one table.
std::vector<Table> pick_tables(const std::vector<Table>& all, const std::vector<int>& rows) {
  std::vector<int> table_of, row_in;
  for (int t = 0; t < static_cast<int>(all.size()); ++t)
    for (int row = 0; row < all[t].rows(); ++row) {
      table_of.push_back(t);
      row_in.push_back(row);
    }
  std::vector<Table> out;
  for (std::size_t i = 0; i < rows.size() && !table_of.empty();) {
    const int t = table_of[rows[i]];
    std::vector<int> run;
    for (; i < rows.size() && table_of[rows[i]] == t; ++i) run.push_back(row_in[rows[i]]);
    out.push_back(picked(all[t], run));
  }
  return out;
}

}  // namespace

double Measurements::mean_axes() const {
  const auto all = static_cast<double>(std::count(has_axis.begin(), has_axis.end(), true));
  if (kind.empty()) return all;
  double sum = 0.0;
  for (int i = 0; i < size(); ++i) sum += axes(i);
  return size() > 0 ? sum / size() : all;
}

int Measurements::usual_axes() const {
  return std::max(1, static_cast<int>(std::lround(mean_axes())));
}

Measurements pick(const Measurements& all, const std::vector<int>& rows) {
  Measurements out;
  out.pose = picked(all.pose, rows);
  out.replicate_group = picked(all.replicate_group, rows);
  out.set = picked(all.set, rows);
  out.setup = picked(all.setup, rows);
  out.kind = picked(all.kind, rows);
  out.placement = picked(all.placement, rows);
  out.file = picked(all.file, rows);
  out.q = picked(all.q, rows);
  out.p_M = picked(all.p_M, rows);
  out.has_axis = all.has_axis;
  out.quat_M = picked(all.quat_M, rows);
  out.sigma_m = picked(all.sigma_m, rows);
  out.nominal_B = picked(all.nominal_B, rows);
  out.departure_B = picked(all.departure_B, rows);
  out.context = pick(all.context, rows);
  return out;
}

MeasurementFiles pick(const MeasurementFiles& all, const std::vector<int>& rows) {
  MeasurementFiles out{pick(static_cast<const Measurements&>(all), rows),
                       pick_tables(all.tables, rows)};
  out.file = file_of_rows(out.tables);
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "cell/contexts.hpp"

#include <algorithm>

#include "cell/iso_time.hpp"
#include "cell/last_moves.hpp"

namespace plumb::offline {
namespace {

int row_count(std::span<const Table> tables) {
  int rows = 0;
  for (const auto& table : tables) rows += table.rows();
  return rows;
}

/// Columns of these names, NaN where a file lacks one; 0 rows if no file has any.
RowsN gathered(std::span<const Table> tables, const std::vector<std::string>& names) {
  const auto has = [&](const Table& t, const std::string& name) {
    const Column* column = t.find(name);
    return column != nullptr && !column->values.empty();
  };
  const bool any = std::any_of(tables.begin(), tables.end(), [&](const Table& t) {
    return std::any_of(names.begin(), names.end(), [&](const auto& name) { return has(t, name); });
  });
  if (!any || names.empty()) return {};
  RowsN out = RowsN::Constant(row_count(tables), static_cast<Eigen::Index>(names.size()), kUnknown);
  int first = 0;
  for (const auto& table : tables) {
    for (std::size_t k = 0; k < names.size(); ++k)
      if (has(table, names[k]))
        for (int i = 0; i < table.rows(); ++i)
          out(first + i, static_cast<Eigen::Index>(k)) = table.find(names[k])->values[i];
    first += table.rows();
  }
  return out;
}

std::vector<std::string> numbered(const std::string& prefix, Eigen::Index joints) {
  std::vector<std::string> out;
  for (Eigen::Index j = 1; j <= joints; ++j) out.push_back(prefix + std::to_string(j));
  return out;
}

std::vector<std::string> sensors_of(std::span<const Table> tables) {
  std::vector<std::string> out;
  for (const auto& table : tables)
    for (const auto& column : table.columns)
      if (column.quantity == Quantity::kTemperature &&
          std::find(out.begin(), out.end(), column.name) == out.end())
        out.push_back(column.name);
  return out;
}

Eigen::VectorXd times_of(std::span<const Table> tables) {
  const auto numbers = gathered(tables, {"t"});
  if (numbers.rows() > 0) return numbers.col(0);
  Eigen::VectorXd out = Eigen::VectorXd::Constant(row_count(tables), kUnknown);
  int first = 0;
  for (const auto& table : tables) {
    if (const Column* column = table.find("time"); column != nullptr)
      for (std::size_t i = 0; i < column->text.size(); ++i)
        out(first + static_cast<int>(i)) = iso_seconds(column->text[i]).value_or(kUnknown);
    first += table.rows();
  }
  return out.hasNaN() ? Eigen::VectorXd() : out;
}

}  // namespace

ContextRows read_contexts(std::span<const Table> tables, const RowsN& q) {
  ContextRows out;
  out.direction = gathered(tables, numbered("dir_j", q.cols()));
  out.travel = gathered(tables, numbered("travel_j", q.cols()));
  out.step = last_moves(tables, q, Neighbours::kTheRowBefore);
  out.payload = gathered(tables, {"payload", "payload_cx", "payload_cy", "payload_cz"});
  out.wrench = gathered(tables, {"fx", "fy", "fz", "mx", "my", "mz"});
  out.sensors = sensors_of(tables);
  out.temperature = gathered(tables, out.sensors);
  out.time_s = times_of(tables);
  out.order = Eigen::VectorXd::LinSpaced(q.rows(), 0.0, static_cast<double>(q.rows() - 1));
  return out;
}

}  // namespace plumb::offline

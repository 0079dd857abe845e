// SPDX-License-Identifier: Apache-2.0
#include "cell/table.hpp"

namespace plumb::offline {

std::vector<int> file_of_rows(const std::vector<Table>& tables) {
  std::vector<int> out;
  for (std::size_t t = 0; t < tables.size(); ++t)
    out.insert(out.end(), tables[t].lines.size(), static_cast<int>(t));
  return out;
}

const Column* Table::find(std::string_view name) const {
  for (const auto& column : columns)
    if (column.name == name) return &column;
  return nullptr;
}

const Column* Table::find_text(std::string_view name) const {
  const Column* column = find(name);
  return column != nullptr && column->quantity == Quantity::kText ? column : nullptr;
}

}  // namespace plumb::offline

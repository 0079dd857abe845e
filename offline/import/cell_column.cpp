// SPDX-License-Identifier: Apache-2.0
#include "import/cell_column.hpp"

namespace plumb::offline {

CellColumn CellColumn::of_rows(const std::vector<int>& rows) const {
  CellColumn out(table_->texts());
  out.table_->expect(rows.size(), rows.size());
  for (const int row : rows) out.add((*this)[static_cast<std::size_t>(row)]);
  return out;
}

}  // namespace plumb::offline

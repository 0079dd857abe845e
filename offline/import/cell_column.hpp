// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "import/cell_table.hpp"

namespace plumb::offline {

/// The texts of one column: a column of a table, or one that is made.
class CellColumn {
 public:
  CellColumn() : CellColumn(std::make_shared<TextStore>()) {}
  CellColumn(std::shared_ptr<CellTable> table, std::size_t column)
      : table_(std::move(table)), column_(column) {}

  std::size_t size() const { return table_->size(); }
  bool empty() const { return table_->empty(); }
  std::string_view operator[](std::size_t row) const { return (*table_)[row][column_]; }
  std::string_view front() const { return (*this)[0]; }
  std::string_view back() const { return (*this)[size() - 1]; }
  ByPosition<CellColumn> begin() const { return {*this, 0}; }
  ByPosition<CellColumn> end() const { return {*this, size()}; }

  /// One more text of a column that is made.
  void add(std::string_view text) { table_->add({text}); }

  /// These rows of the column, in this order.
  CellColumn of_rows(const std::vector<int>& rows) const;

 private:
  explicit CellColumn(std::shared_ptr<TextStore> texts)
      : table_(std::make_shared<CellTable>(std::move(texts))) {}

  std::shared_ptr<CellTable> table_;
  std::size_t column_ = 0;
};

}  // namespace plumb::offline

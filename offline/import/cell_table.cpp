// SPDX-License-Identifier: Apache-2.0
#include "import/cell_table.hpp"

#include <algorithm>

namespace plumb::offline {

void CellTable::expect(std::size_t rows, std::size_t cells) {
  begins_.reserve(rows + 1);
  // Every cell but the first has a separator before it, so that there are no more than bytes.
  cells_.reserve(std::min(cells, texts_->file().size() + 1));
}

void CellTable::add(const std::vector<std::string_view>& row) {
  for (const auto cell : row) cells_.push_back(texts_->keep(cell));
  begins_.push_back(static_cast<std::uint32_t>(cells_.size()));
}

void CellTable::shorten_rows(std::size_t most) {
  std::uint32_t first = 0, filled = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto end = begins_[i + 1];
    for (std::size_t k = first; k < end && k - first < most; ++k) cells_[filled++] = cells_[k];
    begins_[i + 1] = filled;
    first = end;
  }
  cells_.resize(filled);
}

void CellTable::move_row(std::size_t from, std::size_t to) {
  if (from == to) return;
  const auto first = cells_.begin() + begins_[from], end = cells_.begin() + begins_[from + 1];
  const auto moved = std::copy(first, end, cells_.begin() + begins_[to]);
  begins_[to + 1] = static_cast<std::uint32_t>(moved - cells_.begin());
}

}  // namespace plumb::offline

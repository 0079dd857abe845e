// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string_view>
#include <vector>

#include "import/text_store.hpp"

namespace plumb::offline {

/// The elements of a sequence with size() and operator[], by value.
template <class Sequence>
class ByPosition {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = std::string_view;
  using difference_type = std::ptrdiff_t;
  using pointer = const std::string_view*;
  using reference = std::string_view;

  ByPosition(const Sequence& sequence, std::size_t at) : sequence_(&sequence), at_(at) {}
  std::string_view operator*() const { return (*sequence_)[at_]; }
  ByPosition& operator++() {
    ++at_;
    return *this;
  }
  ByPosition operator++(int) { return {*sequence_, at_++}; }
  bool operator==(const ByPosition& other) const { return at_ == other.at_; }

 private:
  const Sequence* sequence_;
  std::size_t at_;
};

/// The cells of one row.
class CellRow {
 public:
  CellRow(const TextStore& texts, const StoredText* first, std::size_t size)
      : texts_(&texts), first_(first), size_(size) {}

  std::size_t size() const { return size_; }
  std::string_view operator[](std::size_t k) const { return (*texts_)[first_[k]]; }
  std::string_view front() const { return (*this)[0]; }
  ByPosition<CellRow> begin() const { return {*this, 0}; }
  ByPosition<CellRow> end() const { return {*this, size_}; }

 private:
  const TextStore* texts_;
  const StoredText* first_;
  std::size_t size_;
};

/// Rows of cells, of any number each.
class CellTable {
 public:
  explicit CellTable(std::shared_ptr<TextStore> texts) : texts_(std::move(texts)) {}

  const std::shared_ptr<TextStore>& texts() const { return texts_; }
  std::size_t size() const { return begins_.size() - 1; }
  bool empty() const { return size() == 0; }
  CellRow operator[](std::size_t row) const {
    return {*texts_, cells_.data() + begins_[row], begins_[row + 1] - begins_[row]};
  }

  /// Reserves memory for so many rows and cells.
  void expect(std::size_t rows, std::size_t cells);

  void add(const std::vector<std::string_view>& row);

  /// Drops the cells of every row behind the first `most`.
  void shorten_rows(std::size_t most);

  /// Replaces the text of a cell.
  void set(std::size_t row, std::size_t k, std::string_view text) {
    StoredText& cell = cells_[begins_[row] + k];
    cell = texts_->keep(text);
  }

  /// The same, but may overwrite the line that the cell stands in. For use when no message will
  /// show that line.
  void write_over(std::size_t row, std::size_t k, std::string_view text) {
    StoredText& cell = cells_[begins_[row] + k];
    cell = texts_->replaced(cell, text);
  }

  /// Keeps the rows that `keep(row)` tells, asked from the first to the last.
  template <class Keep>
  void keep_rows(Keep keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size(); ++i)
      if (keep(i)) move_row(i, kept++);
    truncate(kept);
  }

  void truncate(std::size_t rows) {
    begins_.resize(rows + 1);
    cells_.resize(begins_.back());
  }

 private:
  void move_row(std::size_t from, std::size_t to);

  std::shared_ptr<TextStore> texts_;
  std::vector<StoredText> cells_;
  std::vector<std::uint32_t> begins_{0};  // of each row, and the end of the last
};

}  // namespace plumb::offline

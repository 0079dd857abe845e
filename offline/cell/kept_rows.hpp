// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline {

/// Rows of text in one shared block: copies and picks share it, a row costs two words.
class KeptRows {
 public:
  KeptRows() = default;

  /// Row i is `text` from begins[i], sizes[i] long.
  KeptRows(std::string text, std::vector<std::size_t> begins, std::vector<std::size_t> sizes);

  std::size_t size() const { return begins_.size(); }
  bool empty() const { return begins_.empty(); }
  std::string operator[](std::size_t row) const { return std::string(view(row)); }

  /// Lives as long as any copy of these rows.
  std::string_view view(std::size_t row) const;

  /// Rows added are empty.
  void resize(std::size_t rows);

  KeptRows pick(const std::vector<int>& rows) const;

  class Iterator {
   public:
    Iterator(const KeptRows& rows, std::size_t at) : rows_(&rows), at_(at) {}
    std::string operator*() const { return (*rows_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const KeptRows* rows_;
    std::size_t at_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  std::shared_ptr<const std::string> text_ = std::make_shared<const std::string>();
  std::vector<std::size_t> begins_;
  std::vector<std::size_t> sizes_;
};

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline {

/// A cell's place in a TextStore. A long file has more cells than anything else: eight bytes each.
struct StoredText {
  std::uint64_t begin : 40, size : 24;
};
static_assert(sizeof(StoredText) == 8);

/// The text of a file, and texts of cells that stand in none of its lines. None of them moves.
class TextStore {
 public:
  explicit TextStore(std::string file = {}) : file_(std::move(file)) {}
  TextStore(const TextStore&) = delete;
  TextStore& operator=(const TextStore&) = delete;

  std::string_view file() const { return file_; }

  std::string_view operator[](StoredText text) const {
    if (text.begin + text.size <= file_.size()) return {file_.data() + text.begin, text.size};
    const std::uint64_t behind = text.begin - file_.size();
    return std::string_view(more_[behind / kBlock]).substr(behind % kBlock, text.size);
  }

  /// Where a text stands; one that is no part of the file is copied behind it.
  StoredText keep(std::string_view text);

  /// Replaces a text: it is overwritten in place unless the new one is longer.
  StoredText replaced(StoredText old, std::string_view text);

 private:
  static constexpr std::size_t kBlock = 1 << 24;  // more than the longest text

  static StoredText place(std::size_t begin, std::size_t size) {
    return {.begin = begin % (std::uint64_t{1} << 40), .size = size % kBlock};
  }
  StoredText append(std::string_view text);

  std::string file_;
  std::vector<std::string> more_;  // each of kBlock bytes at most
};

}  // namespace plumb::offline

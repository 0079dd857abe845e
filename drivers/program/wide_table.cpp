// SPDX-License-Identifier: Apache-2.0
#include "program/wide_table.hpp"

#include <algorithm>

namespace plumb {
namespace {

using Characters = std::vector<std::string>;  // of one line, each as its bytes

Characters characters_of(const std::string& line) {
  Characters out;
  for (const char c : line) {
    if ((c & 0xC0) != 0x80 || out.empty()) out.emplace_back();
    out.back() += c;
  }
  return out;
}

struct Column {
  std::size_t begin, end;  // in characters

  std::size_t width() const { return end - begin; }
};

/// Where some row has more than blanks; single blanks stand within a cell.
std::vector<Column> columns_in(const std::vector<Characters>& rows) {
  std::vector<bool> used;
  for (const Characters& row : rows) {
    used.resize(std::max(used.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] != " ") used[i] = true;
  }
  std::vector<Column> out;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    if (!out.empty() && i < out.back().end + 2)
      out.back().end = i + 1;
    else
      out.push_back({i, i + 1});
  }
  return out;
}

std::string cell(const Characters& row, const Column& column) {
  std::string out;
  for (std::size_t i = column.begin; i < column.end; ++i) out += i < row.size() ? row[i] : " ";
  return out;
}

/// The first column, and those from `first` to before `last`.
void append_part(const std::vector<Characters>& rows, const std::vector<Column>& columns,
                 std::size_t first, std::size_t last, std::vector<std::string>& out) {
  for (const Characters& row : rows) {
    std::string line = std::string(columns[0].begin, ' ') + cell(row, columns[0]);
    for (std::size_t k = first; k < last; ++k) line += "  " + cell(row, columns[k]);
    line.erase(line.find_last_not_of(' ') + 1);
    out.push_back(std::move(line));
  }
}

}  // namespace

std::vector<std::string> parted(const std::vector<std::string>& rows, std::size_t columns,
                                std::size_t last_room) {
  std::vector<Characters> split;
  for (const std::string& row : rows) split.push_back(characters_of(row));
  const std::vector<Column> all = columns_in(split);
  if (all.size() < 3) return rows;
  std::vector<std::string> out;
  for (std::size_t first = 1; first < all.size();) {
    std::size_t width = all[0].end, last = first;
    for (; last < all.size(); ++last) {
      const bool is_end = last + 1 == all.size();
      const std::size_t wide = is_end ? std::min(last_room, all[last].width()) : all[last].width();
      if (last > first && width + 2 + wide > columns) break;
      width += 2 + wide;
    }
    if (!out.empty()) out.emplace_back();
    append_part(split, all, first, last, out);
    first = last;
  }
  return out;
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "show/table.hpp"

#include <algorithm>

namespace plumb::offline::show {

std::size_t screen_width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

namespace {

std::string lines_of(const Table& table) {
  std::string out;
  for (const auto& row : table.rows) {
    std::string line = "  " + row.front();
    for (std::size_t k = 1; k < row.size(); ++k)
      if (k == 1)
        line += ": " + row[k];
      else if (!row[k].empty())
        line += "; " + table.head[k] + " " + row[k];
    out += line + "\n";
  }
  return out;
}

}  // namespace

std::string text_of(const Table& table) {
  if (table.rows.empty()) return "";
  const std::string caption = table.captioned ? table.caption + "\n" : "";
  if (table.as_lines) return caption + lines_of(table);
  std::vector<const std::vector<std::string>*> rows{&table.head};
  for (const auto& row : table.rows) rows.push_back(&row);
  std::vector<std::size_t> width;
  for (const auto* row : rows) {
    width.resize(std::max(width.size(), row->size()));
    for (std::size_t k = 0; k < row->size(); ++k)
      width[k] = std::max(width[k], screen_width((*row)[k]));
  }
  std::string out = caption;
  for (const auto* row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row->size(); ++k) {
      const std::string& cell = (*row)[k];
      const std::string pad(width[k] - screen_width(cell), ' ');
      const bool left = k == 0 || k >= table.left_from;
      line += "  " + (left ? cell + pad : pad + cell);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

}  // namespace plumb::offline::show

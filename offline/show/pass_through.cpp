// SPDX-License-Identifier: Apache-2.0
#include "show/pass_through.hpp"

#include <algorithm>

namespace plumb::offline::show {

void split_raw(std::string_view row, std::vector<std::string_view>& cells) {
  cells.clear();
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == '"') quoted = !quoted;
    if (row[i] != ',' || quoted) continue;
    cells.push_back(row.substr(begin, i - begin));
    begin = i + 1;
  }
  cells.push_back(row.substr(begin));
}

PassThrough::PassThrough(std::string_view raw_header, const std::vector<std::string>& ours) {
  std::vector<std::string_view> names;
  split_raw(raw_header, names);
  own_of_input_.assign(names.size(), -1);
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const auto found = std::find(names.begin(), names.end(), ours[k]);
    if (found == names.end()) {
      behind_.push_back(k);
      continue;
    }
    own_of_input_[static_cast<std::size_t>(found - names.begin())] = static_cast<int>(k);
    replaced_.push_back(ours[k]);
  }
  const std::vector<std::string_view> texts(ours.begin(), ours.end());
  append(raw_header, texts, header_);
}

void PassThrough::append(std::string_view raw_row, std::span<const std::string_view> ours,
                         std::string& out) const {
  if (replaced_.empty()) {
    out += raw_row;
  } else {
    std::vector<std::string_view> cells;
    split_raw(raw_row, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) out += ',';
      const int own = i < own_of_input_.size() ? own_of_input_[i] : -1;
      out += own < 0 ? cells[i] : ours[static_cast<std::size_t>(own)];
    }
  }
  for (const std::size_t k : behind_) (out += ',') += ours[k];
  out += '\n';
}

}  // namespace plumb::offline::show

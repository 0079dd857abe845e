// SPDX-License-Identifier: Apache-2.0
#include "cell/kept_rows.hpp"

namespace plumb::offline {

KeptRows::KeptRows(std::string text, std::vector<std::size_t> begins,
                   std::vector<std::size_t> sizes)
    : text_(std::make_shared<const std::string>(std::move(text))),
      begins_(std::move(begins)),
      sizes_(std::move(sizes)) {}

std::string_view KeptRows::view(std::size_t row) const {
  return std::string_view(*text_).substr(begins_[row], sizes_[row]);
}

void KeptRows::resize(std::size_t rows) {
  begins_.resize(rows);
  sizes_.resize(rows);
}

KeptRows KeptRows::pick(const std::vector<int>& rows) const {
  KeptRows out;
  out.text_ = text_;
  for (const int row : rows) {
    out.begins_.push_back(begins_[row]);
    out.sizes_.push_back(sizes_[row]);
  }
  return out;
}

}  // namespace plumb::offline

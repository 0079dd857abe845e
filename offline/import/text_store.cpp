// SPDX-License-Identifier: Apache-2.0
#include "import/text_store.hpp"

#include <algorithm>
#include <functional>

namespace plumb::offline {

StoredText TextStore::keep(std::string_view text) {
  const char* const begin = file_.data();
  const std::less<> before;
  // An empty cell of the file has a place too, which messages show.
  if (before(text.data(), begin) || before(begin + file_.size(), text.data()))
    return text.empty() ? StoredText{} : append(text);
  return place(static_cast<std::size_t>(text.data() - begin), text.size());
}

StoredText TextStore::replaced(StoredText old, std::string_view text) {
  if (text.size() > old.size || old.begin >= file_.size()) return keep(text);
  std::copy(text.begin(), text.end(), file_.begin() + static_cast<std::ptrdiff_t>(old.begin));
  return place(old.begin, text.size());
}

StoredText TextStore::append(std::string_view text) {
  if (more_.empty() || more_.back().size() + text.size() > kBlock)
    more_.emplace_back().reserve(kBlock);
  const std::size_t begin = file_.size() + (more_.size() - 1) * kBlock + more_.back().size();
  more_.back() += text;
  return place(begin, text.size());
}

}  // namespace plumb::offline

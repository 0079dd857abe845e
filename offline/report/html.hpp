// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "show/block.hpp"
#include "show/table.hpp"

namespace plumb::offline::report {

/// The elements of one page, in their order. All words are escaped; only figures come as they are.
class Html {
 public:
  void heading(std::string_view words);
  void paragraph(std::string_view words);
  void list(const std::vector<std::string>& items);  // nothing if there are none
  void table(const show::Table& table);              // nothing without rows
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  void preformatted(std::string_view label, std::string_view text);

  /// A figure laid out for a wide page and for a telephone. `svg`: already escaped.
  void figure(std::string_view wide_svg, std::string_view narrow_svg);

  /// The blocks of a result in their order, what to do next under a heading at the end.
  ///
  /// @param put_figure  Draws the figure of that name here.
  void blocks(const show::Blocks& blocks,
              const std::function<void(const std::string&)>& put_figure);

  /// Elements that are already escaped.
  void raw(std::string_view html) { text_ += html; }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace plumb::offline::report

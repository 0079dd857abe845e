// SPDX-License-Identifier: Apache-2.0
#include "program/toml_inline.hpp"

#include <algorithm>

#include "program/utf8.hpp"

namespace plumb {
namespace {

class Joiner {
 public:
  explicit Joiner(std::string_view text) : text_(text) {}

  std::string join() {
    while (at_ < text_.size()) step();
    return std::move(out_);
  }

 private:
  bool in_inline_table() const { return !open_.empty() && open_.back() == '{'; }

  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return copy_string(c);
    if (c == '#') return comment();
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (in_inline_table() && (c == '\n' || c == '\r')) {
      out_ += ' ';
    } else {
      if (c == '}' && in_inline_table()) drop_last_comma();
      if (c == '{' || c == '[') open_ += c;
      if ((c == '}' || c == ']') && !open_.empty()) open_.pop_back();
      out_ += c;
    }
    if (!blank) last_ = out_.size() - 1;
    ++at_;
  }

  void drop_last_comma() {
    if (last_ < out_.size() && out_[last_] == ',') out_[last_] = ' ';
  }

  void comment() {
    const auto end = std::min(text_.find('\n', at_), text_.size());
    const auto comment = text_.substr(at_, end - at_);
    if (in_inline_table())
      out_.append(static_cast<std::size_t>(count_characters(comment)), ' ');
    else
      out_ += comment;
    at_ = end;
  }

  /// Copies "…", '…' and their three-quote forms; an open one runs to the end of its line or file.
  void copy_string(char quote) {
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_, 3) == three;
    std::size_t end = at_ + (is_long ? 3 : 1);
    for (; end < text_.size(); ++end) {
      if (text_[end] == '\\' && quote == '"') {
        ++end;
      } else if (is_long ? text_.substr(end, 3) == three : text_[end] == quote) {
        end += is_long ? 3 : 1;
        break;
      } else if (!is_long && text_[end] == '\n') {
        break;
      }
    }
    end = std::min(end, text_.size());
    out_ += text_.substr(at_, end - at_);
    last_ = out_.size() - 1;
    at_ = end;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string out_;
  std::string open_;                      // brackets not closed yet
  std::size_t last_ = std::string::npos;  // in out_, the last character that is not blank
};

}  // namespace

std::string join_inline_tables(std::string_view text) { return Joiner(text).join(); }

}  // namespace plumb

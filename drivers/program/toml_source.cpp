// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "program/toml_inline.hpp"
#include "program/toml_table.hpp"
#include "program/utf8.hpp"

namespace plumb {
namespace {

/// Index of the first character (not byte) of each line.
std::vector<std::size_t> line_starts(std::string_view text) {
  std::vector<std::size_t> out{0};
  std::size_t characters = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto newline = text.find('\n', at);
    if (newline == std::string_view::npos) break;
    characters += static_cast<std::size_t>(count_characters(text.substr(at, newline + 1 - at)));
    out.push_back(characters);
    at = newline + 1;
  }
  return out;
}

std::pair<int, int> position(const Problem& problem) {
  if (!problem.place) return {0, 0};
  return {problem.place->line, problem.place->column};
}

std::string line_of(std::string_view text, std::size_t number) {
  for (std::size_t i = 1; i < number; ++i) text.remove_prefix(text.find('\n') + 1);
  auto line = text.substr(0, text.find('\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return std::string(line);
}

}  // namespace

TomlSource::TomlSource(std::string file, std::string text, std::string codes)
    : file_(std::move(file)), text_(std::move(text)), codes_(std::move(codes)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  joined_ = join_inline_tables(text_);
  lines_ = line_starts(text_);
  joined_lines_ = line_starts(joined_);
}

toml::table TomlSource::parse() {
  try {
    return toml::parse(joined_);
  } catch (const toml::parse_error& error) {
    problems_.error("E-TOML", std::string(error.description()), place(error.source(), "here"),
                    "texts need quotes, tables [brackets], lists commas");
    throw Failure(Exit::kInput, problems_.errors());
  }
}

Place TomlSource::place(const toml::source_region& where, std::string label) const {
  Place out{.file = file_, .label = std::move(label)};
  if (where.begin.line < 1 || where.begin.line > joined_lines_.size()) return out;
  const std::size_t character =
      joined_lines_[where.begin.line - 1] + std::max<std::size_t>(1, where.begin.column) - 1;
  const auto behind = std::upper_bound(lines_.begin(), lines_.end(), character);
  out.line = static_cast<int>(behind - lines_.begin());
  out.column = static_cast<int>(character - *(behind - 1)) + 1;
  out.source = line_of(text_, static_cast<std::size_t>(out.line));
  const int rest = std::max(1, count_characters(out.source) - out.column + 1);
  if (where.end.line == where.begin.line && where.end.column > where.begin.column)
    out.length = std::min(rest, static_cast<int>(where.end.column - where.begin.column));
  return out;
}

void TomlSource::stop_on_errors() {
  auto errors = problems_.errors();
  if (errors.empty()) return;
  std::stable_sort(errors.begin(), errors.end(),
                   [](const Problem& a, const Problem& b) { return position(a) < position(b); });
  throw Failure(Exit::kInput, std::move(errors));
}

}  // namespace plumb

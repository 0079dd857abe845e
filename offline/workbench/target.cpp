// SPDX-License-Identifier: Apache-2.0
#include "workbench/target.hpp"

#include "program/printable.hpp"

namespace plumb::offline::workbench {
namespace {

constexpr std::size_t kMostParts = 8, kMostPairs = 16;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

enum class Plus { kItself, kBlank };  // in a query a plus sign stands for a blank

/// "%2e" becomes "."; nothing if the result is no text.
std::optional<std::string> decoded(std::string_view text, Plus plus) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(16 * high + low);
      i += 2;
    } else if (c == '+' && plus == Plus::kBlank) {
      c = ' ';
    }
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) return std::nullopt;
    out += c;
  }
  if (valid_utf8(out) != out) return std::nullopt;
  return out;
}

/// The text up to the separator, which is taken off `rest` with it.
std::string_view cut(std::string_view& rest, char separator) {
  const auto at = rest.find(separator);
  const std::string_view out = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view{} : rest.substr(at + 1);
  return out;
}

bool add_path(std::string_view path, Target& out) {
  if (path.empty() || path.front() != '/') return false;
  path.remove_prefix(1);
  if (path.empty()) return true;
  const bool ends_with_slash = path.back() == '/';
  while (!path.empty()) {
    const auto part = decoded(cut(path, '/'), Plus::kItself);
    if (!part || part->empty() || *part == "." || *part == "..") return false;
    if (part->find_first_of("/\\") != std::string::npos) return false;
    if (out.path.size() == kMostParts) return false;
    out.path.push_back(*part);
  }
  return !ends_with_slash;
}

bool add_query(std::string_view query, Target& out) {
  while (!query.empty()) {
    std::string_view value = cut(query, '&');
    const auto name = decoded(cut(value, '='), Plus::kBlank);
    const auto text = decoded(value, Plus::kBlank);
    if (!name || name->empty() || !text || out.query.size() == kMostPairs) return false;
    if (!out.query.emplace(*name, *text).second) return false;
  }
  return true;
}

}  // namespace

std::optional<Target> parse_target(std::string_view text) {
  if (text.size() > kLongestTarget || text.find('#') != std::string_view::npos) return std::nullopt;
  Target out;
  std::string_view query = text;
  const std::string_view path = cut(query, '?');
  if (!add_path(path, out) || !add_query(query, out)) return std::nullopt;
  return out;
}

}  // namespace plumb::offline::workbench

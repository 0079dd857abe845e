// SPDX-License-Identifier: Apache-2.0
#include "program/printable.hpp"

#include <fmt/format.h>

#include "program/utf8.hpp"

namespace plumb {
namespace {

/// The code point of a well-formed sequence of at least two bytes.
char32_t code_point(std::string_view sequence) {
  const auto first = static_cast<unsigned char>(sequence[0]);
  char32_t out = first & (0xFFu >> (sequence.size() + 1));
  for (std::size_t i = 1; i < sequence.size(); ++i)
    out = (out << 6) | (static_cast<unsigned char>(sequence[i]) & 0x3Fu);
  return out;
}

/// C1 controls; marks, embeddings, overrides and isolates of direction; line separators and
/// invisible characters [Unicode 15, 23.2 and 23.3].
bool is_hidden(char32_t c) {
  return (c >= 0x80 && c <= 0x9F) || c == 0x61C || c == 0x200B || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF;
}

std::string shown_byte(char c) { return fmt::format("\\x{:02x}", static_cast<unsigned char>(c)); }

std::string shown(std::string_view sequence) {
  if (sequence.size() > 1) {
    const char32_t code = code_point(sequence);
    return is_hidden(code) ? fmt::format("\\u{:04x}", static_cast<unsigned>(code))
                           : std::string(sequence);
  }
  const auto byte = static_cast<unsigned char>(sequence[0]);
  return byte < 0x20 || byte >= 0x7F ? shown_byte(sequence[0]) : std::string(sequence);
}

std::size_t shown_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (text.size() < length || find_invalid_utf8(text.substr(0, length)) == 0) return 1;
  return length;
}

bool is_plain(std::string_view text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\t') || byte >= 0x7F) return false;
  }
  return true;
}

}  // namespace

std::string printable_text(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string out;
  out.reserve(text.size() + 16);
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = shown_length(text.substr(i, 4));
    if (text[i] == '\n' || text[i] == '\t')
      out += text[i];
    else
      out += shown(text.substr(i, length));
    i += length;
  }
  return out;
}

std::string valid_utf8(std::string_view text) {
  std::string out;
  for (;;) {
    const std::size_t bad = find_invalid_utf8(text);
    out += text.substr(0, bad);
    if (bad == std::string_view::npos) return out;
    out += "\xEF\xBF\xBD";
    text.remove_prefix(bad + 1);
  }
}

std::string printable_line(std::string_view text) {
  std::string out;
  for (const char c : printable_text(text))
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else
      out += c;
  return out;
}

}  // namespace plumb

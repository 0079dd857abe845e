// SPDX-License-Identifier: Apache-2.0
#include "compile/c_text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

namespace plumb::offline {
namespace {

constexpr std::size_t kColumns = 100;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_word(char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Bytes of the separator or direction mark that `rest` begins with: U+061C, U+200E, U+200F,
/// U+2028 .. U+202E and U+2066 .. U+2069; 0 if none.
std::size_t hidden_mark(std::string_view rest) {
  if (rest.starts_with("\xD8\x9C")) return 2;
  if (rest.size() < 3) return 0;
  const auto last = static_cast<unsigned char>(rest[2]);
  if (rest.starts_with("\xE2\x80"))
    return last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE) ? 3 : 0;
  return rest.starts_with("\xE2\x81") && last >= 0xA6 && last <= 0xA9 ? 3 : 0;
}

bool is_control(char c) { return (c >= '\0' && c < ' ') || c == '\x7F'; }

}  // namespace

std::string c_identifier(const std::string& file) {
  std::string out;
  for (const char c : std::filesystem::path(file).stem().string())
    if (is_word(c))
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty()) return "model";
  return is_digit(out.front()) ? "model_" + out : out;
}

std::string c_comment_text(const std::string& text) {
  std::string out;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t mark = hidden_mark(rest);
    const char c = mark > 0 || is_control(rest.front()) ? ' ' : rest.front();
    const bool opens = !out.empty() && out.back() == '/' && c == '*';
    const bool closes = !out.empty() && out.back() == '*' && c == '/';
    if (opens || closes) out += ' ';
    out += c;
    rest.remove_prefix(mark > 0 ? mark : 1);
  }
  return out;
}

std::string c_number(double x) { return fmt::format("{:#}", x); }

std::string c_table(const std::string& name, const std::vector<double>& numbers, std::size_t row) {
  std::string out = fmt::format("static const double {}[{}] = {{", name, numbers.size());
  std::string line;
  const auto flush = [&] {
    if (!line.empty()) out += "\n   " + line;
    line.clear();
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string next = " " + c_number(numbers[i]) + (i + 1 < numbers.size() ? "," : "");
    if (i % row == 0 || line.size() + next.size() + 3 > kColumns) flush();
    line += next;
  }
  flush();
  return out + "};\n";
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "text_check.hpp"

#include <string_view>

namespace plumb::format::internal {
namespace {

/// Length in bytes of the UTF-8 sequence that begins with `first`; 0 if none begins with it.
std::size_t sequence_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >> 5 == 0x06) return 2;
  if (first >> 4 == 0x0E) return 3;
  return first >> 3 == 0x1E ? 4 : 0;
}

/// Removes the first code point and returns it; empty if it is not valid UTF-8.
std::optional<char32_t> take_code_point(std::string_view& rest) {
  const auto first = static_cast<unsigned char>(rest.front());
  const std::size_t length = sequence_length(first);
  if (length == 0 || length > rest.size()) return std::nullopt;
  char32_t code = length == 1 ? first : first & (0x7FU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(rest[k]);
    if (next >> 6 != 0x02) return std::nullopt;
    code = code << 6 | (next & 0x3FU);
  }
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kSmallest[length] || code > 0x10FFFF || surrogate) return std::nullopt;
  rest.remove_prefix(length);
  return code;
}

}  // namespace

std::optional<std::string> unprintable(const std::string& text, const std::string& what,
                                       std::size_t most) {
  if (text.size() > most) return what + " is longer than " + std::to_string(most) + " bytes";
  for (std::string_view rest = text; !rest.empty();) {
    const auto code = take_code_point(rest);
    if (!code) return what + " is not UTF-8";
    if (*code < 0x20 || (*code >= 0x7F && *code < 0xA0)) return what + " holds control characters";
  }
  return std::nullopt;
}

}  // namespace plumb::format::internal

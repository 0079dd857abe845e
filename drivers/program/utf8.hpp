// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Byte offset of the first byte that is not UTF-8 (overlong forms and surrogates included), or
/// npos. Cost: one pass.
std::size_t find_invalid_utf8(std::string_view text);

/// Characters (code points) of `text`; invalid bytes count one each.
int count_characters(std::string_view text);

/// The characters of a line, fit for a terminal: tabs become spaces; control characters and
/// invalid bytes become U+FFFD, so that a hostile file cannot steer the terminal.
std::vector<std::string> printable_characters(std::string_view line);

/// The text without spaces, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace plumb

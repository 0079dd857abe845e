// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Text that came from a file or the command line, made safe for a terminal: names in files may
/// hold escape sequences that recolour, overwrite or retitle what the user sees.
namespace plumb {

/// The text with every control character, byte that is not UTF-8, and character that changes the
/// direction of writing shown as "\x1b", "\u202e". Newlines and tabs stay.
std::string printable_text(std::string_view text);

/// The same for what must stay on one line: newlines and tabs are shown as "\n" and "\t".
std::string printable_line(std::string_view text);

/// The text with U+FFFD in the place of every byte that is not UTF-8.
std::string valid_utf8(std::string_view text);

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumb::offline {

/// Which byte of a character comes first in a text in UTF-16.
enum class ByteOrder { kBigEndian, kLittleEndian };

/// The byte order of a text in UTF-16 whose byte-order mark is missing; nothing if it is no such
/// text. In European text the high byte of three in four characters and more is 0 and the low byte
/// never is. Looks at the first 64 kB, and concludes nothing from fewer than 16 bytes.
std::optional<ByteOrder> unmarked_utf16(std::string_view bytes);

/// What iconv calls the encoding of a text in UTF-16, with a byte-order mark or without: "UTF-16",
/// "UTF-16LE" or "UTF-16BE"; empty if it is no such text.
std::string utf16_name(std::string_view bytes);

}  // namespace plumb::offline

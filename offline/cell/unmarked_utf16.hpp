// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace plumb::offline {

/// Which byte of a character comes first in a text in UTF-16.
enum class ByteOrder { kBigEndian, kLittleEndian };

/// The byte order of a text in UTF-16 whose byte-order mark is missing; nothing if it is no such
/// text. In European text the high byte of nearly every character is 0 and the low byte never is.
/// Looks at the first 64 kB, and concludes nothing from fewer than 16 bytes.
std::optional<ByteOrder> unmarked_utf16(std::string_view bytes);

}  // namespace plumb::offline

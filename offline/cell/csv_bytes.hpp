// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace plumb::offline {

/// Refuses what is not a text in UTF-8: empty, UTF-16 with its mark or without, zero bytes, other
/// encodings. Throws Failure (kInput) with the place of the first bad byte and the command that
/// converts the file. `first_line`: number of the text's first line in the file.
void check_bytes(std::string_view text, const std::string& file, int first_line = 1);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace plumb::format::internal {

inline constexpr std::size_t kMaxText = 256;  // bytes

/// Why a text cannot be shown on a terminal or in JSON: it is longer than `most` bytes, not UTF-8
/// [RFC 3629], or has control characters. Empty if it can be shown, as an empty text can. `what`:
/// the name of the text, with which the sentence begins.
std::optional<std::string> unprintable(const std::string& text, const std::string& what,
                                       std::size_t most = kMaxText);

}  // namespace plumb::format::internal

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace plumb::format::internal {

inline constexpr std::size_t kMaxText = 256;  // bytes

/// Why a text cannot be shown on a terminal or in JSON: too long, not UTF-8 [RFC 3629],
/// or with control characters. No reason if it can be shown; an empty text can. `what`: beginning
/// of the sentence.
std::optional<std::string> unprintable(const std::string& text, const std::string& what,
                                       std::size_t most = kMaxText);

}  // namespace plumb::format::internal

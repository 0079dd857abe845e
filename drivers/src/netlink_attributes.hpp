// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/netlink.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>

namespace plumb::drivers {

using Bytes = std::span<const std::uint8_t>;

/// The plain struct at the beginning of `bytes`; nothing if there are too few bytes.
template <class T>
std::optional<T> head(Bytes bytes) {
  if (bytes.size() < sizeof(T)) return {};
  T out;
  std::memcpy(&out, bytes.data(), sizeof(T));
  return out;
}

inline Bytes behind(Bytes bytes, std::size_t n) { return bytes.subspan(std::min(n, bytes.size())); }

/// The content of the first attribute of this type in a sequence of attributes; empty if there is
/// none.
inline Bytes attribute(Bytes row, std::uint16_t type) {
  while (const auto header = head<nlattr>(row)) {
    if (header->nla_len < sizeof(nlattr) || header->nla_len > row.size()) return {};
    if ((header->nla_type & NLA_TYPE_MASK) == type)
      return row.subspan(sizeof(nlattr), header->nla_len - sizeof(nlattr));
    row = behind(row, NLA_ALIGN(header->nla_len));
  }
  return {};
}

/// The text up to the terminating 0.
inline std::string text(Bytes bytes) {
  return {bytes.begin(), std::find(bytes.begin(), bytes.end(), 0)};
}

}  // namespace plumb::drivers

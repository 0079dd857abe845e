// SPDX-License-Identifier: Apache-2.0
#include "cell/unmarked_utf16.hpp"

#include <algorithm>
#include <array>

namespace plumb::offline {
namespace {

constexpr std::size_t kBytesLookedAt = 1 << 16;
constexpr std::size_t kShortestUtf16 = 16;  // bytes

}  // namespace

std::optional<ByteOrder> unmarked_utf16(std::string_view bytes) {
  const auto part = bytes.substr(0, std::min(kBytesLookedAt, bytes.size() / 2 * 2));
  if (part.size() < kShortestUtf16) return std::nullopt;
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < part.size(); ++i) zeros[i % 2] += part[i] == '\0' ? 1U : 0U;
  for (std::size_t half = 0; half < 2; ++half)
    if (zeros[half] * 4 >= part.size() / 2 * 3 && zeros[1 - half] == 0)
      return half == 0 ? ByteOrder::kBigEndian : ByteOrder::kLittleEndian;
  return std::nullopt;
}

std::string utf16_name(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return "UTF-16";
  const auto order = unmarked_utf16(bytes);
  if (!order) return "";
  return *order == ByteOrder::kBigEndian ? "UTF-16BE" : "UTF-16LE";
}

}  // namespace plumb::offline

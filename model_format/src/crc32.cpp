// SPDX-License-Identifier: Apache-2.0
#include "plumb/format/crc32.hpp"

#include <array>

namespace plumb::format {
namespace {

constexpr std::uint32_t kReflected = 0xC8DF352F;  // 0xF4ACFB13 with its bits reversed

constexpr std::array<std::uint32_t, 256> make_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? (c >> 1) ^ kReflected : c >> 1;
    table[i] = c;
  }
  return table;
}

constexpr auto kTable = make_table();

}  // namespace

std::uint32_t crc32p4(std::span<const std::byte> bytes) noexcept {
  std::uint32_t c = 0xFFFFFFFF;
  for (const std::byte b : bytes) c = kTable[(c ^ static_cast<std::uint8_t>(b)) & 0xFF] ^ (c >> 8);
  return c ^ 0xFFFFFFFF;
}

}  // namespace plumb::format

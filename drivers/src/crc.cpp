// SPDX-License-Identifier: Apache-2.0
#include "crc.hpp"

#include <array>

namespace plumb::drivers {
namespace {

constexpr std::array<std::uint8_t, 256> crc8_table() {
  std::array<std::uint8_t, 256> out{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value << 1) ^ ((value & 0x80U) != 0 ? 0x12FU : 0U);
    out[i] = static_cast<std::uint8_t>(value);
  }
  return out;
}

/// The table of the reflected algorithm, whose polynomial is 0xF4ACFB13 with the bits in reverse
/// order.
constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> out{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1U) != 0 ? 0xC8DF352FU : 0U);
    out[i] = value;
  }
  return out;
}

constexpr auto kCrc8 = crc8_table();
constexpr auto kCrc32 = crc32_table();

std::array<std::uint8_t, 4> bytes_of(std::uint32_t id) noexcept {
  return {static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8),
          static_cast<std::uint8_t>(id >> 16), static_cast<std::uint8_t>(id >> 24)};
}

std::uint8_t crc8_go_on(std::uint8_t value, std::span<const std::uint8_t> data) noexcept {
  for (const std::uint8_t byte : data) value = kCrc8[value ^ byte];
  return value;
}

}  // namespace

std::uint8_t crc8(std::span<const std::uint8_t> data) noexcept {
  return static_cast<std::uint8_t>(~crc8_go_on(0xFF, data));
}

std::uint8_t crc8_of(std::uint32_t id, std::span<const std::uint8_t> data) noexcept {
  return static_cast<std::uint8_t>(~crc8_go_on(crc8_go_on(0xFF, bytes_of(id)), data));
}

void Crc32P4::add(std::uint8_t byte) noexcept {
  register_ = (register_ >> 8) ^ kCrc32[(register_ ^ byte) & 0xFFU];
}

void Crc32P4::add(std::uint32_t id, std::span<const std::uint8_t> data) noexcept {
  for (const std::uint8_t byte : bytes_of(id)) add(byte);
  for (const std::uint8_t byte : data) add(byte);
}

}  // namespace plumb::drivers

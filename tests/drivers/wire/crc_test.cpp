// SPDX-License-Identifier: Apache-2.0
#include "crc.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

const std::vector<std::uint8_t> kDigits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};

/// Bit by bit, the polynomial as written, bits in and out turned round.
std::uint32_t literal_crc32p4(std::span<const std::uint8_t> data) {
  const auto reverse = [](std::uint32_t value, int bits) {
    std::uint32_t out = 0;
    for (int i = 0; i < bits; ++i) out |= (value >> i & 1U) << (bits - 1 - i);
    return out;
  };
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::uint8_t byte : data) {
    crc ^= reverse(byte, 8) << 24;
    for (int i = 0; i < 8; ++i) crc = (crc << 1) ^ ((crc >> 31) != 0 ? 0xF4ACFB13U : 0U);
  }
  return ~reverse(crc, 32);
}

std::uint8_t literal_crc8(std::span<const std::uint8_t> data) {
  unsigned crc = 0xFF;
  for (const std::uint8_t byte : data)
    for (int i = 7; i >= 0; --i) {
      const unsigned top = (crc >> 7 ^ byte >> i) & 1U;
      crc = ((crc << 1) ^ (top != 0 ? 0x2FU : 0U)) & 0xFFU;
    }
  return static_cast<std::uint8_t>(crc ^ 0xFFU);
}

std::uint32_t crc32p4(std::span<const std::uint8_t> data) {
  Crc32P4 crc;
  for (const std::uint8_t byte : data) crc.add(byte);
  return crc.value();
}

TEST(Crc, HasTheCheckValuesThatAutosarPublishes) {
  EXPECT_EQ(crc8(kDigits), 0xDF);
  EXPECT_EQ(crc32p4(kDigits), 0x1697D06AU);
  EXPECT_EQ(literal_crc8(kDigits), 0xDF);
  EXPECT_EQ(literal_crc32p4(kDigits), 0x1697D06AU);
}

TEST(Crc, CoversTheIdentifierAsFourBytesLowByteFirst) {
  const std::vector<std::uint8_t> whole{0x78, 0x56, 0x34, 0x12, 'a', 'b'};
  const std::vector<std::uint8_t> data{'a', 'b'};
  EXPECT_EQ(crc8_of(0x12345678, data), crc8(whole));
  Crc32P4 crc;
  crc.add(0x12345678, data);
  EXPECT_EQ(crc.value(), crc32p4(whole));
}

TEST(Crc, TheTablesAgreeWithTheBitwiseDefinitionForAnyBytes) {
  tests::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> data(static_cast<std::size_t>(random.below(80)));
    for (auto& byte : data) byte = static_cast<std::uint8_t>(random.bits());
    ASSERT_EQ(crc8(data), literal_crc8(data));
    ASSERT_EQ(crc32p4(data), literal_crc32p4(data));
  }
}

}  // namespace
}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#include "trailer.hpp"

#include <algorithm>
#include <array>

#include "plumb/format/crc32.hpp"

namespace plumb::format::internal {
namespace {

constexpr std::array<char, 8> kMagic{'P', 'L', 'U', 'M', 'B', 'S', 'U', 'M'};

void append_u32(std::vector<std::byte>& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<std::byte>((value >> shift) & 0xFF));
}

std::uint32_t read_u32(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

}  // namespace

void append_trailer(std::vector<std::byte>& bytes) {
  const auto payload = static_cast<std::uint32_t>(bytes.size());
  for (char c : kMagic) bytes.push_back(static_cast<std::byte>(c));
  append_u32(bytes, payload);
  append_u32(bytes, crc32p4(bytes));
}

TrailerState check_trailer(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kTrailerBytes) return TrailerState::kMissing;
  const auto trailer = bytes.last(kTrailerBytes);
  const bool magic = std::equal(kMagic.begin(), kMagic.end(), trailer.begin(),
                                [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
  if (!magic) return TrailerState::kMissing;
  if (read_u32(trailer.subspan(8)) != bytes.size() - kTrailerBytes)
    return TrailerState::kWrongLength;
  const auto summed = bytes.first(bytes.size() - 4);
  return crc32p4(summed) == read_u32(bytes.last(4)) ? TrailerState::kSound
                                                    : TrailerState::kWrongChecksum;
}

}  // namespace plumb::format::internal

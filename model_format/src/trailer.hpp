// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// The 16 bytes behind the flatbuffer: "PLUMBSUM", length of the payload, CRC-32P4.
namespace plumb::format::internal {

inline constexpr std::size_t kTrailerBytes = 16;

/// Appends the trailer to a payload whose length is a multiple of 8.
void append_trailer(std::vector<std::byte>& bytes);

enum class TrailerState { kSound, kMissing, kWrongLength, kWrongChecksum };
TrailerState check_trailer(std::span<const std::byte> bytes) noexcept;

}  // namespace plumb::format::internal

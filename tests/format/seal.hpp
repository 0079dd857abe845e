// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb::format {

using Bytes = std::vector<std::byte>;

inline constexpr std::size_t kTrailer = 16;  // bytes

/// CRC-32P4 by long division, bit by bit, straight from the polynomial 0xF4ACFB13.
std::uint32_t divided_crc(const std::byte* data, std::size_t size);

/// The checksum made right again, so a corruption reaches the verifier and the semantic check.
Bytes resealed(Bytes file);

/// A payload padded to 8 bytes, with the trailer that model.fbs describes.
Bytes sealed(Bytes payload);

/// Schema version by hand, as model.fbs promises it for ever: the first field of the root table.
std::uint32_t stated_schema(const Bytes& file);

/// Little endian at `at`.
void put_u32(Bytes& bytes, std::size_t at, std::uint32_t value);

}  // namespace plumb::format

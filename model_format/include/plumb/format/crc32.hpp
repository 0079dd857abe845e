// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace plumb::format {

/// CRC-32P4 (polynomial 0xF4ACFB13, reflected, as in AUTOSAR E2E profile 4).
/// crc32p4("123456789") = 0x1697D06A. No state, any thread.
std::uint32_t crc32p4(std::span<const std::byte> bytes) noexcept;

}  // namespace plumb::format

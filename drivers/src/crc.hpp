// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace plumb::drivers {

/// Check sums over an identifier (as four bytes, low byte first) and then `data`. Both detect every
/// error of up to three bits in our messages.
///
/// CRC-8H2F, polynomial 0x2F, start and final xor 0xFF. [AUTOSAR, Specification of CRC Routines]
std::uint8_t crc8_of(std::uint32_t id, std::span<const std::uint8_t> data) noexcept;
std::uint8_t crc8(std::span<const std::uint8_t> data) noexcept;

/// CRC-32P4, polynomial 0xF4ACFB13 reflected, start and final xor 0xFFFFFFFF. [AUTOSAR, as above]
class Crc32P4 {
 public:
  void add(std::uint8_t byte) noexcept;
  void add(std::uint32_t id, std::span<const std::uint8_t> data) noexcept;
  std::uint32_t value() const noexcept { return ~register_; }

 private:
  std::uint32_t register_ = 0xFFFFFFFFU;
};

}  // namespace plumb::drivers

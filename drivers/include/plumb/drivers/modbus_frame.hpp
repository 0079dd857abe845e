// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace plumb::drivers {

/// Function codes of the Modbus application protocol V1.1b3 that move registers.
enum class ModbusFunction : std::uint8_t {
  kReadHolding = 3,
  kReadInput = 4,
  kWriteSingle = 6,
  kWriteMultiple = 16,
  kReadWrite = 23,
};

enum class ModbusException : std::uint8_t {
  kIllegalFunction = 1,
  kIllegalAddress = 2,
  kIllegalValue = 3,
  kBusy = 6,
  kNoSuchUnit = 11,  // gateway: target device failed to respond
};

// Limits of the Modbus application protocol V1.1b3; PDU: function code and data.
inline constexpr std::size_t kMostPdu = 253;  // bytes
inline constexpr std::size_t kMbapHeader = 7;
inline constexpr std::size_t kMostTcpFrame = kMbapHeader + kMostPdu;
inline constexpr std::uint16_t kMostRead = 125;  // registers
inline constexpr std::uint16_t kMostWrite = 123;
inline constexpr std::uint16_t kMostReadWriteWrite = 121;

inline std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t i) noexcept {
  return static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]);
}
inline void set_word(std::span<std::uint8_t> bytes, std::size_t i, std::uint16_t word) noexcept {
  bytes[i] = static_cast<std::uint8_t>(word >> 8);
  bytes[i + 1] = static_cast<std::uint8_t>(word & 0xff);
}

/// Header of a Modbus TCP frame: transaction, protocol (0), number of bytes that follow, unit.
struct MbapHeader {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 0;
  std::uint16_t pdu_size = 0;  // 1 .. kMostPdu
};
/// Writes the header into the first kMbapHeader bytes of `frame`.
void put_header(const MbapHeader& header, std::span<std::uint8_t> frame) noexcept;

/// Divides a stream of arbitrary bytes into Modbus TCP frames. It stores one frame at most.
class ModbusFramer {
 public:
  enum class Cut : std::uint8_t {
    kPart,    // the frame is not complete yet
    kFrame,   // a frame is complete; header() and pdu() are valid until the next call
    kBroken,  // this is not Modbus TCP; nothing more of the stream can be used
  };

  /// The memory to receive into; never empty after next() has returned kPart.
  std::span<std::uint8_t> room() noexcept { return std::span(bytes_).subspan(used_); }
  void filled(std::size_t count) noexcept { used_ += count; }

  Cut next() noexcept;

  const MbapHeader& header() const noexcept { return header_; }
  std::span<const std::uint8_t> pdu() const noexcept {
    return std::span(bytes_).subspan(kMbapHeader, header_.pdu_size);
  }

  /// True if the beginning of an incomplete frame is stored.
  bool part() const noexcept { return used_ > taken_; }

 private:
  void drop_taken() noexcept;

  std::array<std::uint8_t, kMostTcpFrame> bytes_{};
  std::size_t used_ = 0;
  std::size_t taken_ = 0;  // size of the frame given out last
  MbapHeader header_;
};

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modbus_spans.hpp"
#include "plumb/drivers/bus_port.hpp"

namespace plumb::drivers {

/// Which of the blocks that a client writes the server refuses.
///
/// A server that is busy for a moment refuses too. A block therefore counts as refused once it was
/// refused for kLimit_ns and nothing of it was taken in between. It does so until it is taken, or
/// has not been written for kForget_ns: nobody knows then, and it is tried again.
///
/// Heap: in the constructor. Thread: one.
class WriteRefusals {
 public:
  /// Chosen: the limit is as long as an input may be old (InputSettings::limit_s); and a message
  /// that is written at all is written many times in kForget_ns.
  static constexpr std::int64_t kLimit_ns = 100'000'000, kForget_ns = 5'000'000'000;

  /// blocks: those that the client writes; the same indices are used below.
  explicit WriteRefusals(std::size_t blocks) : since_(blocks) {}

  void taken(std::size_t block) noexcept { since_[block] = {}; }
  void refused(std::size_t block, std::uint32_t exception, std::int64_t now_ns) noexcept;

  /// The first block that is refused now; nothing if none is.
  WriteRefusal find(const std::vector<ModbusBlock>& blocks, std::int64_t now_ns) noexcept;

 private:
  struct Since {
    std::uint32_t exception = 0;  // of the last refusal; 0: the block is not refused
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;
  };
  std::vector<Since> since_;
};

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_codec.hpp"

namespace plumb::drivers {

/// The registers of one message.
struct ModbusBlock {
  MessageKind kind = MessageKind::kJoints;
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  double period_s = 0;
};

/// Blocks that one request reads, and the registers between them.
struct ModbusSpan {
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  double period_s = 0;  // the shortest among its blocks
  std::vector<ModbusBlock> blocks;
};

/// The blocks of one side, in the order of their registers.
std::vector<ModbusBlock> blocks_of(const BusLayout& layout, const ModbusCodec& codec, Sender side);

/// As few spans as there can be, of `most` registers or fewer, with gaps of `widest_gap` or less.
std::vector<ModbusSpan> join(const std::vector<ModbusBlock>& blocks, int most, int widest_gap);

/// Each block by itself.
std::vector<ModbusSpan> split(const ModbusSpan& span);

}  // namespace plumb::drivers

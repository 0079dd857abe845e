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

/// Blocks that are read with one request, including the registers between them.
struct ModbusSpan {
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  double period_s = 0;  // the shortest among its blocks
  std::vector<ModbusBlock> blocks;
};

/// The blocks of one side, in the order of their registers.
std::vector<ModbusBlock> blocks_of(const BusLayout& layout, const ModbusCodec& codec, Sender side);

/// The smallest number of spans that hold these blocks, each with at most `most` registers and gaps
/// of at most `widest_gap`.
std::vector<ModbusSpan> join(const std::vector<ModbusBlock>& blocks, int most, int widest_gap);

/// One span for each block.
std::vector<ModbusSpan> split(const ModbusSpan& span);

}  // namespace plumb::drivers

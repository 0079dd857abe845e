// SPDX-License-Identifier: Apache-2.0
#include "modbus_spans.hpp"

#include <algorithm>

namespace plumb::drivers {

std::vector<ModbusBlock> blocks_of(const BusLayout& layout, const ModbusCodec& codec, Sender side) {
  std::vector<ModbusBlock> out;
  for (const auto& message : layout.messages) {
    const auto [first, count] = codec.block(message.kind);
    if (message.sender != side || count == 0) continue;
    out.push_back(
        {.kind = message.kind, .first = first, .count = count, .period_s = message.period_s});
  }
  std::sort(out.begin(), out.end(),
            [](const ModbusBlock& a, const ModbusBlock& b) { return a.first < b.first; });
  return out;
}

std::vector<ModbusSpan> join(const std::vector<ModbusBlock>& blocks, int most, int widest_gap) {
  std::vector<ModbusSpan> out;
  for (const auto& block : blocks) {
    const int end = block.first + block.count;
    const bool fits = !out.empty() && end - out.back().first <= most &&
                      block.first - (out.back().first + out.back().count) <= widest_gap;
    if (!fits) out.push_back({block.first, 0, block.period_s, {}});
    ModbusSpan& span = out.back();
    span.count = static_cast<std::uint16_t>(end - span.first);
    span.period_s = std::min(span.period_s, block.period_s);
    span.blocks.push_back(block);
  }
  return out;
}

std::vector<ModbusSpan> split(const ModbusSpan& span) {
  std::vector<ModbusSpan> out;
  for (const auto& block : span.blocks)
    out.push_back({block.first, block.count, block.period_s, {block}});
  return out;
}

}  // namespace plumb::drivers

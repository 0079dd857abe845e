// SPDX-License-Identifier: Apache-2.0
#include "modbus_writer.hpp"

#include <algorithm>

#include "link_thread.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

/// True for messages that decide where the other side moves.
bool matters(MessageKind kind) {
  return kind == MessageKind::kCorrected || kind == MessageKind::kOffset ||
         kind == MessageKind::kTarget;
}

}  // namespace

ModbusWriter::ModbusWriter(const BusLayout& layout, const ModbusCodec& codec,
                           const ModbusClientSettings& settings, ModbusTalk& talk,
                           ModbusExchange& exchange)
    : codec_(codec),
      settings_(settings),
      talk_(talk),
      exchange_(exchange),
      blocks_(blocks_of(layout, codec, settings.self)) {}

bool ModbusWriter::round(std::int64_t now_ns) {
  run_ = {};
  for (const auto& block : blocks_) {
    BusMessage message;
    if (!take_fresh(block, now_ns, message)) continue;
    const bool joins = run_.first + run_.count == block.first &&
                       run_.count + block.count <= static_cast<int>(run_.registers.size());
    if (!joins && !write_run(now_ns)) return false;
    if (run_.count == 0) run_.first = block.first;
    if (!codec_.encode(message, std::span(run_.registers).subspan(run_.count, block.count)))
      continue;
    run_.count = static_cast<std::uint16_t>(run_.count + block.count);
    run_.messages += 1;
    run_.matters = run_.matters || matters(block.kind);
  }
  return write_run(now_ns);
}

bool ModbusWriter::take_fresh(const ModbusBlock& block, std::int64_t now_ns, BusMessage& message) {
  if (!exchange_.to_peer[static_cast<std::size_t>(block.kind)].take(message)) return false;
  if (now_ns - message.time_ns <= to_ns(settings_.stale_after_s)) return true;
  ++exchange_.counters.stale;
  return false;
}

bool ModbusWriter::write_run(std::int64_t now_ns) {
  if (run_.count == 0) return true;
  const ModbusTalk::Result result = talk_.write(run_.first, run_.content());
  const bool done = result == ModbusTalk::Result::kDone;
  for (int i = 0; done && i < run_.messages; ++i) ++exchange_.counters.sent;
  const bool due = done && run_.matters && now_ns >= read_back_due_ns_;
  const bool good = ModbusTalk::goes_on(result) && (!due || read_back());
  run_ = {};
  return good;
}

bool ModbusWriter::read_back() {
  const auto found = std::span(found_).first(run_.count);
  const ModbusTalk::Result result = talk_.read(run_.first, found);
  if (result == ModbusTalk::Result::kDone) {
    if (std::ranges::equal(found, run_.content())) {
      read_back_due_ns_ = MonotonicTime::now_ns() + to_ns(settings_.read_back_period_s);
    } else {
      ++exchange_.counters.foreign_senders;
      talk_.note_unclean();
    }
  }
  return ModbusTalk::goes_on(result);
}

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#include "modbus_writer.hpp"

#include <utility>

#include "link_thread.hpp"

namespace plumb::drivers {
ModbusWriter::ModbusWriter(const BusLayout& layout, const ModbusCodec& codec,
                           const ModbusClientSettings& settings, ModbusTalk& talk,
                           ModbusOwner& owner, ModbusExchange& exchange)
    : codec_(codec),
      settings_(settings),
      talk_(talk),
      owner_(owner),
      exchange_(exchange),
      blocks_(blocks_of(layout, codec, settings.self)),
      refusals_(blocks_.size()) {}

bool ModbusWriter::round(std::int64_t now_ns) {
  WriteRefusal refusal = refusals_.find(blocks_, now_ns);
  if (!refusal.any()) refusal = owner_.refusal(now_ns);
  exchange_.refusal.store(refusal, std::memory_order_relaxed);
  if (!owner_.may_write()) return true;
  run_ = {};
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const ModbusBlock& block = blocks_[i];
    BusMessage message;
    if (!take_fresh(block, now_ns, message)) continue;
    const bool joins = run_.first + run_.count == block.first &&
                       run_.count + block.count <= static_cast<int>(run_.registers.size());
    if (!joins && !write_run(now_ns)) return false;
    if (run_.count == 0) run_.first = block.first;
    if (!codec_.encode(message, std::span(run_.registers).subspan(run_.count, block.count)))
      continue;
    run_.count = static_cast<std::uint16_t>(run_.count + block.count);
    run_.blocks[run_.messages++] = i;
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
  const Run run = std::exchange(run_, {});
  if (!owner_.look_before(run.first, run.count, now_ns)) return false;
  if (!owner_.may_write() || owner_.sight_is_old()) return true;
  owner_.write_begins(run.first, run.content());
  const ModbusTalk::Result result = talk_.write(run.first, run.content());
  count(run, result, now_ns);
  if (result != ModbusTalk::Result::kDone) return ModbusTalk::goes_on(result);
  owner_.write_done(run.first, run.content());
  return true;
}

void ModbusWriter::count(const Run& run, ModbusTalk::Result result, std::int64_t now_ns) noexcept {
  if (result == ModbusTalk::Result::kRefused) {
    ++exchange_.counters.refused_writes;
    const auto exception = static_cast<std::uint32_t>(talk_.exception());
    for (const std::size_t block : run.parts()) refusals_.refused(block, exception, now_ns);
  } else if (result == ModbusTalk::Result::kDone) {
    for (const std::size_t block : run.parts()) {
      ++exchange_.counters.sent;
      refusals_.taken(block);
    }
  }
}

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#include "modbus_reader.hpp"

#include <algorithm>

#include "link_thread.hpp"
#include "modbus_faults.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

constexpr double kShortestPoll_s = 100e-6;
constexpr double kPollWithoutReads_s = 1e-3;
constexpr std::int64_t kLook_ns = 200'000'000;

Sender other(Sender side) { return side == Sender::kPlumb ? Sender::kController : Sender::kPlumb; }

}  // namespace

ModbusReader::ModbusReader(const BusLayout& layout, ModbusCodec& codec,
                           const ModbusClientSettings& settings, ModbusTalk& talk,
                           ModbusExchange& exchange)
    : codec_(codec), talk_(talk), exchange_(exchange), packing_(layout, codec, exchange) {
  const auto spans =
      join(blocks_of(layout, codec_, other(settings.self)), kMostRead, widest_gap(settings));
  double wake_s = spans.empty() ? kPollWithoutReads_s : spans.front().period_s / 2;
  for (const auto& span : spans) wake_s = std::min(wake_s, span.period_s / 2);
  if (settings.poll_period_s > 0) wake_s = settings.poll_period_s;
  wake_ns_ = to_ns(std::max(wake_s, kShortestPoll_s));
  for (const auto& span : spans) polls_.push_back(poll_of(span));
}

ModbusReader::Poll ModbusReader::poll_of(const ModbusSpan& span) const {
  return {.span = span, .period_ns = std::max(wake_ns_, to_ns(span.period_s / 2)), .due_ns = 0};
}

void ModbusReader::begin() noexcept {
  for (Poll& poll : polls_) poll.due_ns = 0;
}

bool ModbusReader::round(std::int64_t now_ns) {
  for (std::size_t i = 0; i < polls_.size(); ++i) {
    Poll& poll = polls_[i];
    if (poll.due_ns > now_ns + wake_ns_ / 2) continue;  // read in the round nearest to the due time
    corrupt_ = false;
    const ModbusTalk::Result result = read(poll.span);
    if (!ModbusTalk::goes_on(result)) return false;
    poll.due_ns += poll.period_ns;
    if (poll.due_ns <= now_ns) poll.due_ns = now_ns + poll.period_ns;
    const bool missed = corrupt_ || result == ModbusTalk::Result::kRefused;
    if (missed && !look_around(poll.span, now_ns)) return false;
    if (result == ModbusTalk::Result::kRefused) split_if_gaps_are_refused(i);
  }
  return true;
}

/// Reads the blocks of this span one by one from now on, if the server refused the registers
/// between them. A server need not have those.
void ModbusReader::split_if_gaps_are_refused(std::size_t poll) {
  const ModbusSpan span = polls_[poll].span;
  if (talk_.exception() != ModbusException::kIllegalAddress || span.blocks.size() < 2) return;
  polls_.erase(polls_.begin() + static_cast<std::ptrdiff_t>(poll));
  for (const auto& single : split(span)) polls_.push_back(poll_of(single));
}

ModbusTalk::Result ModbusReader::read(const ModbusSpan& span) {
  const auto registers = std::span(registers_).first(span.count);
  const ModbusTalk::Result result = talk_.read(span.first, registers);
  if (result != ModbusTalk::Result::kDone) return result;
  const std::int64_t now_ns = MonotonicTime::now_ns();
  for (const auto& block : span.blocks) take(block, span, now_ns);
  return result;
}

/// Reads the registers of a message once more, shifted by one to either side, as long as no message
/// has a right check sum: the peer may count its registers from 1. Returns false if the connection
/// can no longer be used.
bool ModbusReader::look_around(const ModbusSpan& span, std::int64_t now_ns) {
  if (span.blocks.size() != 1 || now_ns < look_ns_ || packing_.understands(now_ns)) return true;
  look_ns_ = now_ns + kLook_ns;
  for (const int shift : {1, -1}) {
    const auto first = static_cast<std::uint16_t>(span.first + shift);
    const auto registers = std::span(registers_).first(span.count);
    const ModbusTalk::Result result = talk_.read(first, registers);
    if (!ModbusTalk::goes_on(result)) return false;
    if (result == ModbusTalk::Result::kDone)
      packing_.wrong(span.blocks.front().kind, first, registers);
  }
  return true;
}

void ModbusReader::take(const ModbusBlock& block, const ModbusSpan& span, std::int64_t now_ns) {
  const auto around = std::span<const std::uint16_t>(registers_).first(span.count);
  BusMessage message;
  const Heard heard =
      codec_.decode(block.kind, around.subspan(block.first - span.first, block.count), message);
  if (heard == Heard::kComplete) {
    message.time_ns = now_ns;
    exchange_.from_peer[static_cast<std::size_t>(block.kind)].put(message);
    ++exchange_.counters.received;
    packing_.right(block.kind, now_ns);
  } else if (heard == Heard::kCorrupt) {
    ++exchange_.counters.corrupt;
    packing_.wrong(block.kind, span.first, around);
    corrupt_ = true;
    talk_.note_unclean();
  }
}

}  // namespace plumb::drivers

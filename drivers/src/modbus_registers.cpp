// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_registers.hpp"

#include <algorithm>

#include "packing_watch.hpp"

namespace plumb::drivers {
namespace {

constexpr std::int64_t kPeriodsUntilStale =
    3;  // a slow message is not stale between two of its own

}  // namespace

ModbusRegisters::ModbusRegisters(const BusLayout& layout, Sender self, std::int64_t stale_after_ns,
                                 ModbusExchange& exchange)
    : codec_(layout),
      exchange_(&exchange),
      packing_(std::make_unique<PackingWatch>(layout, codec_, exchange)),
      values_(kAddresses),
      peers_(kAddresses) {
  for (const auto& entry : layout.messages) {
    const auto [first, count] = codec_.block(entry.kind);
    if (count == 0 || first + std::size_t{count} > kAddresses) continue;
    const bool ours = entry.sender == self;
    const auto periods_ns = kPeriodsUntilStale * static_cast<std::int64_t>(entry.period_s * 1e9);
    (ours ? ours_ : theirs_)
        .push_back({.kind = entry.kind,
                    .first = first,
                    .count = count,
                    .stale_after_ns = std::max(stale_after_ns, periods_ns)});
    std::fill_n(peers_.begin() + first, count, !ours);
    begin_ = std::min<std::size_t>(begin_, first);
    end_ = std::max(end_, first + std::size_t{count});
  }
  if (self != Sender::kController || !layout.owner_register) return;
  const std::size_t first = *layout.owner_register;
  if (first + kOwnerRegisters > kAddresses) return;
  std::fill_n(peers_.begin() + static_cast<std::ptrdiff_t>(first), kOwnerRegisters, true);
  begin_ = std::min(begin_, first);
  end_ = std::max(end_, first + kOwnerRegisters);
}

ModbusRegisters::~ModbusRegisters() = default;

bool ModbusRegisters::readable(std::uint16_t first, std::uint16_t count) const noexcept {
  return count > 0 && first >= begin_ && first + std::size_t{count} <= end_;
}

bool ModbusRegisters::writable(std::uint16_t first, std::uint16_t count) const noexcept {
  if (!readable(first, count)) return false;
  return std::all_of(peers_.begin() + first, peers_.begin() + first + count,
                     [](bool peer) { return peer; });
}

std::span<const std::uint16_t> ModbusRegisters::read(std::uint16_t first, std::uint16_t count,
                                                     std::int64_t now_ns) noexcept {
  for (Message& message : ours_)
    if (message.first < first + count && first < message.first + message.count)
      renew(message, now_ns);
  return std::span(values_).subspan(first, count);
}

void ModbusRegisters::write(std::uint16_t address, std::uint16_t value,
                            std::int64_t now_ns) noexcept {
  values_[address] = value;
  for (const Message& message : theirs_)
    if (address == message.first + message.count - 1) hear(message, now_ns);
}

std::span<std::uint16_t> ModbusRegisters::block(const Message& message) noexcept {
  return std::span(values_).subspan(message.first, message.count);
}

void ModbusRegisters::renew(Message& message, std::int64_t now_ns) noexcept {
  BusMessage newest;
  if (exchange_->to_peer[static_cast<std::size_t>(message.kind)].take(newest) &&
      codec_.encode(newest, block(message))) {
    message.time_ns = newest.time_ns;
    message.sound = true;
    ++exchange_->counters.sent;
  }
  if (!message.sound || now_ns - message.time_ns <= message.stale_after_ns) return;
  ModbusCodec::withdraw(block(message));
  message.sound = false;
  ++exchange_->counters.stale;
}

void ModbusRegisters::hear(const Message& message, std::int64_t now_ns) noexcept {
  BusMessage heard;
  ModbusCounters& counters = exchange_->counters;
  switch (codec_.decode(message.kind, block(message), heard)) {
    case Heard::kComplete:
      heard.time_ns = now_ns;
      exchange_->from_peer[static_cast<std::size_t>(message.kind)].put(heard);
      ++counters.received;
      packing_->right(message.kind, now_ns);
      break;
    case Heard::kRepeated:
      ++counters.repeated;
      break;
    case Heard::kCorrupt:
      packing_->wrong(message.kind, 0, values_);
      [[fallthrough]];
    default:
      ++counters.corrupt;
  }
}

void ModbusRegisters::refused(std::uint16_t first, std::span<const std::uint16_t> words) noexcept {
  const std::size_t end = first + words.size();
  for (const Message& message : theirs_)
    if (first < message.first + message.count && message.first < end)
      packing_->wrong(message.kind, first, words);
}

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_codec.hpp"

#include <algorithm>

#include "crc.hpp"
#include "wire_number.hpp"

namespace plumb::drivers {
namespace {

constexpr int kValueBytes = 4;
constexpr std::size_t kCheckSumWords = 2;

bool is_blank(std::span<const std::uint16_t> registers) noexcept {
  return std::all_of(registers.begin(), registers.end(), [](std::uint16_t w) { return w == 0; });
}

}  // namespace

ModbusCodec::ModbusCodec(const BusLayout& layout) : word_order_(layout.word_order) {
  for (const MessageLayout& message : layout.messages) {
    Known& entry = known_[static_cast<std::size_t>(message.kind)];
    entry.present = true;
    entry.size = static_cast<std::uint8_t>(message.signals.size());
    entry.block = {message.first_register, static_cast<std::uint16_t>(modbus_registers(message))};
    for (std::size_t i = 0; i < message.signals.size(); ++i)
      entry.scale[i] = message.signals[i].scale;
  }
}

std::uint32_t ModbusCodec::check_sum(std::uint16_t address,
                                     std::span<const std::uint16_t> registers) noexcept {
  Crc32P4 crc;
  crc.add(address, {});
  for (const std::uint16_t word : registers) {
    crc.add(static_cast<std::uint8_t>(word >> 8));
    crc.add(static_cast<std::uint8_t>(word));
  }
  return crc.value();
}

ModbusCodec::Block ModbusCodec::block(MessageKind kind) const noexcept { return known(kind).block; }

void ModbusCodec::put_pair(std::uint32_t bits, std::uint16_t* at) const noexcept {
  const bool big = word_order_ == ByteOrder::kBig;
  at[big ? 0 : 1] = static_cast<std::uint16_t>(bits >> 16);
  at[big ? 1 : 0] = static_cast<std::uint16_t>(bits);
}

std::uint32_t ModbusCodec::get_pair(const std::uint16_t* at) const noexcept {
  const bool big = word_order_ == ByteOrder::kBig;
  return std::uint32_t{at[big ? 0 : 1]} << 16 | at[big ? 1 : 0];
}

bool ModbusCodec::encode(const BusMessage& message,
                         std::span<std::uint16_t> registers) const noexcept {
  const Known& entry = known(message.kind);
  if (!entry.present || registers.size() != entry.block.count) return false;
  for (std::size_t i = 0; i < entry.size; ++i)
    put_pair(static_cast<std::uint32_t>(to_counts(message.values[i], entry.scale[i], kValueBytes)),
             &registers[2 * i]);
  const std::size_t counter = 2U * entry.size;
  registers[counter] = message.counter;
  put_pair(check_sum(entry.block.first, registers.first(counter + 1)), &registers[counter + 1]);
  return true;
}

void ModbusCodec::withdraw(std::span<std::uint16_t> registers) noexcept {
  for (std::uint16_t& word : registers.last(kCheckSumWords))
    word = static_cast<std::uint16_t>(~word);
}

Heard ModbusCodec::decode(MessageKind kind, std::span<const std::uint16_t> registers,
                          BusMessage& out) noexcept {
  Known& entry = known_[static_cast<std::size_t>(kind)];
  if (!entry.present) return Heard::kNotOurs;
  if (registers.size() != entry.block.count) return Heard::kCorrupt;
  const std::size_t counter = 2U * entry.size;
  const std::uint32_t found = get_pair(&registers[counter + 1]);
  const std::uint32_t right = check_sum(entry.block.first, registers.first(counter + 1));
  if (found == ~right || (!entry.heard && is_blank(registers))) return Heard::kNothing;
  if (found != right) return Heard::kCorrupt;
  if (entry.heard && entry.last == registers[counter]) return Heard::kRepeated;
  entry.heard = true;
  entry.last = registers[counter];
  out = {};
  out.kind = kind;
  out.size = entry.size;
  out.counter = registers[counter];
  for (std::size_t i = 0; i < entry.size; ++i)
    out.values[i] = from_counts(static_cast<std::int32_t>(get_pair(&registers[2 * i])),
                                entry.scale[i], kValueBytes);
  return Heard::kComplete;
}

}  // namespace plumb::drivers

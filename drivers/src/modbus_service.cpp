// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_service.hpp"

#include <algorithm>

namespace plumb::drivers {
namespace {

constexpr std::size_t kReadSize = 5;           // function, first, count
constexpr std::size_t kWriteSingleSize = 5;    // function, address, value
constexpr std::size_t kWriteMultipleHead = 6;  // function, first, count, bytes
constexpr std::size_t kReadWriteHead = 10;     // function, twice first and count, bytes

/// True if the request consists of its head, whose last byte is the number of bytes that follow,
/// and `count` registers (at most `most`).
bool holds_words(std::span<const std::uint8_t> pdu, std::size_t head, std::uint16_t count,
                 std::uint16_t most) {
  return count >= 1 && count <= most && pdu.size() == head + 2 * std::size_t{count} &&
         pdu[head - 1] == 2 * count;
}

}  // namespace

ModbusService::Bytes ModbusService::answer(Bytes pdu, const ModbusPeer& peer,
                                           std::int64_t now_ns) noexcept {
  if (pdu.empty()) return refuse(0, ModbusException::kIllegalFunction);
  switch (ModbusFunction{pdu[0]}) {
    case ModbusFunction::kReadHolding:
    case ModbusFunction::kReadInput:
      return read(pdu, now_ns);
    case ModbusFunction::kWriteSingle:
      return write_single(pdu, peer, now_ns);
    case ModbusFunction::kWriteMultiple:
      return write_multiple(pdu, peer, now_ns);
    case ModbusFunction::kReadWrite:
      return read_write(pdu, peer, now_ns);
  }
  return refuse(pdu[0], ModbusException::kIllegalFunction);
}

ModbusService::Bytes ModbusService::refuse(std::uint8_t function, ModbusException why) noexcept {
  ++counters_->refusals;
  answer_[0] = function | 0x80;
  answer_[1] = static_cast<std::uint8_t>(why);
  return std::span(answer_).first(2);
}

void ModbusService::leave(std::uint64_t peer) noexcept {
  if (writer_.number == peer) writer_ = 0;
}

ModbusService::Bytes ModbusService::served(std::size_t size) noexcept {
  ++counters_->transactions;
  return std::span(answer_).first(size);
}

ModbusService::Bytes ModbusService::read(Bytes pdu, std::int64_t now_ns) noexcept {
  if (pdu.size() != kReadSize) return refuse(pdu[0], ModbusException::kIllegalValue);
  const std::uint16_t first = word_at(pdu, 1);
  const std::uint16_t count = word_at(pdu, 3);
  if (count < 1 || count > kMostRead) return refuse(pdu[0], ModbusException::kIllegalValue);
  if (!registers_->readable(first, count)) return refuse(pdu[0], ModbusException::kIllegalAddress);
  return registers_answer(pdu[0], first, count, now_ns);
}

ModbusService::Bytes ModbusService::write_single(Bytes pdu, const ModbusPeer& peer,
                                                 std::int64_t now_ns) noexcept {
  if (pdu.size() != kWriteSingleSize) return refuse(pdu[0], ModbusException::kIllegalValue);
  const std::uint16_t address = word_at(pdu, 1);
  if (const auto why = objection(address, 1, peer, now_ns)) return refuse(pdu[0], *why);
  registers_->write(address, word_at(pdu, 3), now_ns);
  std::copy(pdu.begin(), pdu.end(), answer_.begin());
  return served(kWriteSingleSize);
}

ModbusService::Bytes ModbusService::write_multiple(Bytes pdu, const ModbusPeer& peer,
                                                   std::int64_t now_ns) noexcept {
  if (pdu.size() < kWriteMultipleHead) return refuse(pdu[0], ModbusException::kIllegalValue);
  const std::uint16_t first = word_at(pdu, 1);
  const std::uint16_t count = word_at(pdu, 3);
  if (!holds_words(pdu, kWriteMultipleHead, count, kMostWrite))
    return refuse(pdu[0], ModbusException::kIllegalValue);
  const Bytes words = pdu.subspan(kWriteMultipleHead);
  if (const auto why = objection(first, count, peer, now_ns))
    return refuse_words(pdu[0], *why, first, words);
  store(first, words, now_ns);
  std::copy_n(pdu.begin(), kReadSize, answer_.begin());
  return served(kReadSize);
}

ModbusService::Bytes ModbusService::read_write(Bytes pdu, const ModbusPeer& peer,
                                               std::int64_t now_ns) noexcept {
  if (pdu.size() < kReadWriteHead) return refuse(pdu[0], ModbusException::kIllegalValue);
  const std::uint16_t read_first = word_at(pdu, 1);
  const std::uint16_t read_count = word_at(pdu, 3);
  const std::uint16_t write_first = word_at(pdu, 5);
  const std::uint16_t write_count = word_at(pdu, 7);
  if (read_count < 1 || read_count > kMostRead ||
      !holds_words(pdu, kReadWriteHead, write_count, kMostReadWriteWrite))
    return refuse(pdu[0], ModbusException::kIllegalValue);
  if (!registers_->readable(read_first, read_count))
    return refuse(pdu[0], ModbusException::kIllegalAddress);
  const Bytes words = pdu.subspan(kReadWriteHead);
  if (const auto why = objection(write_first, write_count, peer, now_ns))
    return refuse_words(pdu[0], *why, write_first, words);
  store(write_first, words, now_ns);
  return registers_answer(pdu[0], read_first, read_count, now_ns);
}

ModbusService::Bytes ModbusService::registers_answer(std::uint8_t function, std::uint16_t first,
                                                     std::uint16_t count,
                                                     std::int64_t now_ns) noexcept {
  const auto words = registers_->read(first, count, now_ns);
  answer_[0] = function;
  answer_[1] = static_cast<std::uint8_t>(2 * count);
  for (std::size_t i = 0; i < words.size(); ++i) set_word(answer_, 2 + 2 * i, words[i]);
  return served(2 + 2 * words.size());
}

/// True if another connection writes, which then counts this one as a second sender.
bool ModbusService::holds(const ModbusPeer& peer, std::int64_t now_ns) noexcept {
  const bool other = writer_.number != 0 && writer_.number != peer.number;
  if (!other || now_ns - written_ns_ >= writer_hold_ns_) return false;
  if (peer.host == writer_.host && peer.number > writer_.number) return false;
  const bool first = is_superseded(peer) && belated_ != peer.number;
  if (!first) ++counters_->foreign_senders;
  if (first) belated_ = peer.number;
  return true;
}

std::optional<ModbusException> ModbusService::objection(std::uint16_t first, std::uint16_t count,
                                                        const ModbusPeer& peer,
                                                        std::int64_t now_ns) noexcept {
  if (!registers_->writable(first, count)) return ModbusException::kIllegalAddress;
  if (holds(peer, now_ns)) return ModbusException::kBusy;
  writer_ = peer;
  written_ns_ = now_ns;
  return std::nullopt;
}

ModbusService::Bytes ModbusService::refuse_words(std::uint8_t function, ModbusException why,
                                                 std::uint16_t first, Bytes words) noexcept {
  std::array<std::uint16_t, kMostWrite> content{};
  const std::size_t count = std::min(words.size() / 2, content.size());
  for (std::size_t i = 0; i < count; ++i) content[i] = word_at(words, 2 * i);
  if (why == ModbusException::kIllegalAddress)
    registers_->refused(first, std::span(content).first(count));
  return refuse(function, why);
}

void ModbusService::store(std::uint16_t first, Bytes words, std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < words.size() / 2; ++i)
    registers_->write(static_cast<std::uint16_t>(first + i), word_at(words, 2 * i), now_ns);
}

}  // namespace plumb::drivers

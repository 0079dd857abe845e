// SPDX-License-Identifier: Apache-2.0
#include "packing_watch.hpp"

#include <algorithm>
#include <utility>

namespace plumb::drivers {
namespace {

constexpr std::int64_t kRecent_ns = 1'000'000'000;  // for understands()
constexpr std::size_t kSumRegisters = 2;            // of the check sum, at the end of a message

std::uint16_t bytes_swapped(std::uint16_t word) noexcept {
  return static_cast<std::uint16_t>(word << 8 | word >> 8);
}

}  // namespace

PackingWatch::PackingWatch(const BusLayout& layout, const ModbusCodec& codec,
                           ModbusExchange& exchange)
    : codec_(codec), exchange_(exchange), high_first_(layout.word_order == ByteOrder::kBig) {}

bool PackingWatch::understands(std::int64_t now_ns) const noexcept {
  return right_ns_ != 0 && now_ns - right_ns_ < kRecent_ns;
}

void PackingWatch::right(MessageKind kind, std::int64_t now_ns) noexcept {
  right_ns_ = now_ns;
  Suspicion& of = kinds_[static_cast<std::size_t>(kind)];
  if (of.right) return;
  of = {};
  of.right = true;
  publish();
}

void PackingWatch::wrong(MessageKind kind, std::uint16_t from, Words around) noexcept {
  Suspicion& of = kinds_[static_cast<std::size_t>(kind)];
  of.right = false;
  const ModbusCodec::Block block = codec_.block(kind);
  RegisterPacking packing = of.packing;
  const Words there = packing.any() ? at(packing, block, from, around) : Words{};
  if ((there.empty() || !holds(packing, block, there)) && !find(block, from, around, packing)) {
    if (there.empty()) return publish();  // what is suspected cannot be seen in these registers
    of = {};
    return publish();
  }
  packing.kind = kind;
  const Words sum = at(packing, block, from, around).last(kSumRegisters);
  const std::uint32_t said = std::uint32_t{sum[0]} << 16 | sum[1];
  if (of.messages > 0 && said == of.last_sum) return;  // the same message again
  of.messages = of.messages > 0 && packing == of.packing ? std::min(of.messages + 1, kInARow) : 1;
  of.packing = packing;
  of.last_sum = said;
  publish();
}

/// The registers where a message stands if it is packed so; empty: they are not known.
PackingWatch::Words PackingWatch::at(const RegisterPacking& packing, ModbusCodec::Block block,
                                     std::uint16_t from, Words around) const noexcept {
  const int begin = block.first + packing.shift - from;
  const bool known = begin >= 0 && static_cast<std::size_t>(begin) + block.count <= around.size();
  return known ? around.subspan(static_cast<std::size_t>(begin), block.count) : Words{};
}

/// True if the sum of these registers is right once they are packed as the layout says.
bool PackingWatch::holds(const RegisterPacking& packing, ModbusCodec::Block block,
                         Words there) const noexcept {
  using Swapped = RegisterPacking::Words;
  std::array<std::uint16_t, kMostRegisters> as_laid_out{};
  const std::size_t size = std::min(there.size(), as_laid_out.size());
  std::copy_n(there.begin(), size, as_laid_out.begin());
  if (packing.bytes_swapped)
    for (std::uint16_t& word : as_laid_out) word = bytes_swapped(word);
  const std::size_t sum = size - kSumRegisters;
  if (packing.words != Swapped::kAsLaidOut)
    for (std::size_t i = 0; i + 1 < sum; i += 2) std::swap(as_laid_out[i], as_laid_out[i + 1]);
  if (packing.words == Swapped::kAll) std::swap(as_laid_out[sum], as_laid_out[sum + 1]);
  const std::uint32_t high = as_laid_out[sum + (high_first_ ? 0 : 1)];
  const std::uint32_t said = high << 16 | as_laid_out[sum + (high_first_ ? 1 : 0)];
  const auto address = static_cast<std::uint16_t>(
      block.first + (packing.sum_address == RegisterPacking::Sum::kAsSent ? packing.shift : 0));
  const Words summed = packing.sum_content == RegisterPacking::Sum::kAsSent
                           ? there.first(sum)
                           : Words(as_laid_out).first(sum);
  return said == ModbusCodec::check_sum(address, summed);
}

/// Tries all packings but that of the layout, the simplest ones first.
bool PackingWatch::find(ModbusCodec::Block block, std::uint16_t from, Words around,
                        RegisterPacking& packing) const noexcept {
  using Swapped = RegisterPacking::Words;
  using Sum = RegisterPacking::Sum;
  for (const int shift : {0, 1, -1})
    for (const bool bytes : {false, true})
      for (const Swapped words : {Swapped::kAsLaidOut, Swapped::kAll, Swapped::kValues})
        for (const Sum content : {Sum::kAsSent, Sum::kAsLaidOut})
          for (const Sum address : {Sum::kAsSent, Sum::kAsLaidOut}) {
            packing = {.words = words,
                       .bytes_swapped = bytes,
                       .shift = static_cast<std::int8_t>(shift),
                       .sum_content = content,
                       .sum_address = address};
            const Words there = at(packing, block, from, around);
            if (packing.any() && !there.empty() && holds(packing, block, there)) return true;
          }
  return false;
}

/// The first kind of message of which a packing is known.
void PackingWatch::publish() noexcept {
  RegisterPacking out;
  bool others_right = false;
  for (const Suspicion& of : kinds_) {
    if (of.messages >= kInARow && !out.any()) out = of.packing;
    others_right = others_right || of.right;
  }
  out.alone = out.any() && others_right;
  exchange_.packing.store(out, std::memory_order_relaxed);
}

}  // namespace plumb::drivers

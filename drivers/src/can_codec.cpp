// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_codec.hpp"

#include <algorithm>
#include <cmath>

#include "crc.hpp"
#include "wire_number.hpp"

namespace plumb::drivers {
namespace {

std::uint32_t check_sum(const CanFrame& frame, const CanForm& form) noexcept {
  const std::span<const std::uint8_t> covered(frame.data.data(), form.check_byte);
  if (form.check_bytes == 1) return crc8_of(frame.id, covered);
  Crc32P4 crc;
  crc.add(frame.id, covered);
  return crc.value();
}

/// How far the counter `to` is ahead of `from`. The counter has one or two bytes and wraps around.
std::uint16_t ahead(std::uint16_t from, std::uint16_t to, int bytes) noexcept {
  const unsigned width = bytes == 1 ? 0xFFU : 0xFFFFU;
  return static_cast<std::uint16_t>((to - from) & width);
}

}  // namespace

CanCodec::CanCodec(const BusLayout& layout)
    : format_(layout.can_format), id_kind_(layout.id_kind), order_(layout.byte_order) {
  double cycle_s = layout.messages.empty() ? 1.0 : layout.messages.front().period_s;
  for (const MessageLayout& message : layout.messages)
    cycle_s = std::min(cycle_s, message.period_s);
  cycle_ns_ = std::llround(cycle_s * 1e9);
  for (const MessageLayout& message : layout.messages) {
    Known entry;
    entry.kind = message.kind;
    entry.size = static_cast<std::uint8_t>(message.signals.size());
    entry.first_id = message.can_id;
    entry.form = can_form(layout, message);
    entry.step = static_cast<int>(std::lround(message.period_s / cycle_s));
    for (std::size_t i = 0; i < message.signals.size(); ++i)
      entry.scale[i] = message.signals[i].scale;
    known_.push_back(entry);
  }
}

std::span<const CanFrame> CanCodec::encode(const BusMessage& message) noexcept {
  for (const Known& entry : known_) {
    if (entry.kind != message.kind) continue;
    for (std::size_t i = 0; i < entry.form.frames; ++i) {
      frames_[i] = {};
      frames_[i].id = entry.first_id + static_cast<std::uint32_t>(i);
      write(message, entry, frames_[i]);
    }
    return {frames_.data(), entry.form.frames};
  }
  return {};
}

void CanCodec::write(const BusMessage& message, const Known& entry,
                     CanFrame& frame) const noexcept {
  const CanForm& form = entry.form;
  frame.id_kind = id_kind_;
  frame.format = format_;
  frame.length = form.length;
  const std::size_t first = (frame.id - entry.first_id) * form.values;
  for (std::size_t i = 0; i < form.values && first + i < entry.size; ++i) {
    const std::int32_t counts =
        to_counts(message.values[first + i], entry.scale[first + i], form.value_bytes);
    put(&frame.data[i * form.value_bytes], static_cast<std::uint32_t>(counts), form.value_bytes,
        order_);
  }
  put(&frame.data[form.counter_byte], message.counter, form.counter_bytes, order_);
  put(&frame.data[form.check_byte], check_sum(frame, form), form.check_bytes, order_);
}

Heard CanCodec::hear(const CanFrame& frame, BusMessage& out) noexcept {
  Known* const entry = frame.id_kind == id_kind_ ? known(frame.id) : nullptr;
  if (entry == nullptr) return Heard::kNotOurs;
  Part part;
  if (!sound(frame, entry->form) || !read(frame, *entry, part)) return Heard::kCorrupt;
  return collect(*entry, part, out);
}

CanCodec::Known* CanCodec::known(std::uint32_t id) noexcept {
  for (Known& entry : known_)
    if (id - entry.first_id < entry.form.frames) return &entry;
  return nullptr;
}

bool CanCodec::sound(const CanFrame& frame, const CanForm& form) const noexcept {
  if (frame.format != format_ || frame.length != form.length) return false;
  if (get(&frame.data[form.check_byte], form.check_bytes, order_) != check_sum(frame, form))
    return false;
  const std::uint8_t* const data = frame.data.data();
  return std::all_of(data + form.check_byte + form.check_bytes, data + form.length,
                     [](std::uint8_t byte) { return byte == 0; });
}

/// Reads the counter and the values of a frame. Returns false if an unused place of the frame is
/// not 0.
bool CanCodec::read(const CanFrame& frame, const Known& entry, Part& out) const noexcept {
  const CanForm& form = entry.form;
  out.index = frame.id - entry.first_id;
  out.time_ns = frame.time_ns;
  out.counter =
      static_cast<std::uint16_t>(get(&frame.data[form.counter_byte], form.counter_bytes, order_));
  for (std::size_t i = 0; i < form.values; ++i) {
    const std::int32_t counts =
        get_signed(&frame.data[i * form.value_bytes], form.value_bytes, order_);
    if (out.index * form.values + i < entry.size)
      out.counts[i] = counts;
    else if (counts != 0)
      return false;
  }
  return true;
}

Heard CanCodec::collect(Known& entry, const Part& part, BusMessage& out) noexcept {
  if (overtaken(entry, part)) return Heard::kRepeated;
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): 1 or 2 bytes
  const std::int64_t round_ns = cycle_ns_ * (std::int64_t{1} << (8 * entry.form.counter_bytes - 1));
  const std::size_t first = part.index * entry.form.values;
  const auto values = std::min<std::size_t>(entry.form.values, entry.size - first);
  const auto same = [&] {
    return std::equal(part.counts.begin(), part.counts.begin() + values,
                      entry.counts.begin() + first);
  };
  const std::uint32_t bit = 1U << part.index;
  const bool goes_on =
      entry.parts != 0 && part.counter == entry.counter && part.time_ns - entry.begun_ns < round_ns;
  if (goes_on && (entry.parts & bit) != 0 && same()) return Heard::kRepeated;
  if (!goes_on || (entry.parts & bit) != 0) {
    incomplete_ += entry.parts != 0 ? 1 : 0;
    entry.parts = 0;
    entry.counter = part.counter;
    entry.begun_ns = part.time_ns;
  }
  std::copy_n(part.counts.begin(), values, entry.counts.begin() + first);
  entry.parts |= bit;
  return entry.parts == (1U << entry.form.frames) - 1 ? complete(entry, out) : Heard::kPart;
}

bool CanCodec::overtaken(const Known& entry, const Part& part) const noexcept {
  const auto behind = [&](std::uint16_t counter, std::int64_t time_ns, int least) {
    const int gap = ahead(part.counter, counter, entry.form.counter_bytes);
    return gap >= least && gap < kOvertaken && part.time_ns - time_ns < kOvertaken * cycle_ns_;
  };
  return (entry.heard && behind(entry.last, entry.last_ns, 0)) ||
         (entry.parts != 0 && behind(entry.counter, entry.begun_ns, 1));
}

Heard CanCodec::complete(Known& entry, BusMessage& out) noexcept {
  out = {};
  out.kind = entry.kind;
  out.size = entry.size;
  out.counter = entry.counter;
  out.time_ns = entry.begun_ns;
  for (std::size_t i = 0; i < entry.size; ++i)
    out.values[i] = from_counts(entry.counts[i], entry.scale[i], entry.form.value_bytes);
  count_skipped(entry);
  entry.parts = 0;
  entry.heard = true;
  entry.last = entry.counter;
  entry.last_ns = entry.begun_ns;
  return Heard::kComplete;
}

/// Counts the messages that were skipped. A counter that is ahead by half its range or more is not
/// counted, because the sender then has restarted.
void CanCodec::count_skipped(const Known& entry) noexcept {
  const int gap = ahead(entry.last, entry.counter, entry.form.counter_bytes);
  if (!entry.heard || gap >= 1 << (8 * entry.form.counter_bytes - 1)) return;
  skipped_ += static_cast<std::uint64_t>(std::max(0, gap / entry.step - 1));
}

}  // namespace plumb::drivers

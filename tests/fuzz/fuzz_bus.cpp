// SPDX-License-Identifier: Apache-2.0
// Any frames and registers into the codecs: nothing counts whose check sum is wrong, and whatever
// comes out is finite or unknown. The check sums here are computed bit by bit.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plumb/drivers/can_codec.hpp"
#include "plumb/drivers/modbus_codec.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using namespace plumb::drivers;
using plumb::tests::require;

std::uint32_t literal_crc32p4(const std::vector<std::uint8_t>& data) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : data)
    for (int i = 0; i < 8; ++i)
      crc = (crc >> 1) ^ (((crc ^ byte >> i) & 1U) != 0 ? 0xC8DF352FU : 0U);
  return ~crc;
}

std::uint32_t literal_crc8(const std::vector<std::uint8_t>& data) {
  unsigned crc = 0xFF;
  for (const std::uint8_t byte : data)
    for (int i = 7; i >= 0; --i) {
      const unsigned top = (crc >> 7 ^ byte >> i) & 1U;
      crc = ((crc << 1) ^ (top != 0 ? 0x2FU : 0U)) & 0xFFU;
    }
  return crc ^ 0xFFU;
}

/// Takes bytes from the front; zeros when there are no more.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  bool empty() const { return left_ == 0; }
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

BusLayout layout_of(unsigned choice) {
  BusLayout out =
      default_layout(1 + static_cast<int>(choice >> 4) % 9, 0.004, 2,
                     (choice & 1) != 0 ? CorrectionForm::kOffset : CorrectionForm::kPose);
  if ((choice & 2) != 0) out.can_format = CanFrame::Format::kFd;
  if ((choice & 4) != 0) out.byte_order = ByteOrder::kBig;
  if ((choice & 8) != 0) out.word_order = ByteOrder::kLittle;
  return out;
}

std::uint32_t get(const std::uint8_t* at, int bytes, ByteOrder order) {
  std::uint32_t out = 0;
  for (int i = 0; i < bytes; ++i)
    out |= std::uint32_t{at[order == ByteOrder::kLittle ? i : bytes - 1 - i]} << 8 * i;
  return out;
}

void put(std::uint8_t* at, std::uint32_t bits, int bytes, ByteOrder order) {
  for (int i = 0; i < bytes; ++i)
    at[order == ByteOrder::kLittle ? i : bytes - 1 - i] = static_cast<std::uint8_t>(bits >> 8 * i);
}

/// The message and form a frame would have to have; null: none.
const MessageLayout* message_of(const BusLayout& layout, std::uint32_t id) {
  for (const MessageLayout& m : layout.messages)
    if (id >= m.can_id && id < m.can_id + can_frames(layout, m)) return &m;
  return nullptr;
}

std::uint32_t literal_sum(const CanFrame& frame, const CanForm& form) {
  std::vector<std::uint8_t> covered;
  for (int i = 0; i < 4; ++i) covered.push_back(static_cast<std::uint8_t>(frame.id >> 8 * i));
  covered.insert(covered.end(), frame.data.begin(), frame.data.begin() + form.check_byte);
  return form.check_bytes == 1 ? literal_crc8(covered) : literal_crc32p4(covered);
}

void require_sane(const BusMessage& message) {
  require(message.size <= kMaxMessageValues, "no more values than a message holds");
  for (std::size_t i = 0; i < kMaxMessageValues; ++i) {
    const double value = message.values[i];
    require(std::isnan(value) || (i < message.size && std::abs(value) < 1e10),
            "values are unknown or within the wire's range");
  }
}

/// Identifier near ours, shape mostly right, check sum put right half of the time.
CanFrame frame_from(Bytes& bytes, const BusLayout& layout, std::int64_t& now) {
  CanFrame frame;
  const unsigned how = bytes.next();
  frame.id = 0x110U + bytes.next();
  frame.format = (how & 1) != 0 ? CanFrame::Format::kClassic : layout.can_format;
  if ((how & 2) != 0) frame.id_kind = CanFrame::Id::kExtended;
  now += (how & 4) != 0 ? 4'000'000LL << (how >> 5) : 1000;
  frame.time_ns = now;
  const MessageLayout* message = message_of(layout, frame.id);
  const CanForm form = can_form(layout, message != nullptr ? *message : layout.messages.front());
  frame.length = (how & 8) != 0 ? static_cast<std::uint8_t>(bytes.next() % 65) : form.length;
  const std::size_t fill = message != nullptr && (how & 8) == 0
                               ? std::size_t{form.check_byte} + form.check_bytes
                               : frame.length;
  for (std::size_t i = 0; i < fill; ++i) frame.data[i] = bytes.next();
  if ((how & 16) != 0)
    put(&frame.data[form.check_byte], literal_sum(frame, form), form.check_bytes,
        layout.byte_order);
  return frame;
}

void hear(CanCodec& codec, const BusLayout& layout, const CanFrame& frame) {
  BusMessage out;
  const Heard heard = codec.hear(frame, out);
  if (heard == Heard::kNotOurs || heard == Heard::kCorrupt) return;
  const MessageLayout* message = message_of(layout, frame.id);
  require(message != nullptr, "what counts has an identifier of the layout");
  const CanForm form = can_form(layout, *message);
  require(frame.format == layout.can_format && frame.length == form.length &&
              frame.id_kind == layout.id_kind,
          "what counts has the shape of the layout");
  require(get(&frame.data[form.check_byte], form.check_bytes, layout.byte_order) ==
              literal_sum(frame, form),
          "what counts has a right check sum");
  if (heard != Heard::kComplete) return;
  require(out.kind == message->kind && out.size == message->signals.size(),
          "a message is that of its frames");
  require_sane(out);
}

void decode(Bytes& bytes, ModbusCodec& codec, const BusLayout& layout) {
  const unsigned how = bytes.next();
  const auto kind = static_cast<MessageKind>(how % kMessageKinds);
  const auto block = codec.block(kind);
  std::vector<std::uint16_t> words((how & 64) != 0 ? bytes.next() % 40U : block.count);
  for (auto& word : words) word = static_cast<std::uint16_t>(bytes.next() << 8 | bytes.next());
  const auto literal = [&] {
    std::vector<std::uint8_t> covered{static_cast<std::uint8_t>(block.first),
                                      static_cast<std::uint8_t>(block.first >> 8), 0, 0};
    for (std::size_t i = 0; i + 2 < words.size(); ++i) {
      covered.push_back(static_cast<std::uint8_t>(words[i] >> 8));
      covered.push_back(static_cast<std::uint8_t>(words[i]));
    }
    return literal_crc32p4(covered);
  };
  const std::size_t high = layout.word_order == ByteOrder::kBig ? 2 : 1;
  if ((how & 128) != 0 && words.size() >= 3) {
    words[words.size() - high] = static_cast<std::uint16_t>(literal() >> 16);
    words[words.size() - (3 - high)] = static_cast<std::uint16_t>(literal());
  }
  BusMessage out;
  const Heard heard = codec.decode(kind, words, out);
  if (heard == Heard::kNotOurs || heard == Heard::kCorrupt) return;
  require(words.size() == block.count, "a block that counts has its size");
  const std::uint32_t found =
      std::uint32_t{words[words.size() - high]} << 16 | words[words.size() - (3 - high)];
  if (heard == Heard::kNothing) {
    const bool blank = std::ranges::all_of(words, [](std::uint16_t word) { return word == 0; });
    require(blank || found == ~literal(), "a block that holds nothing was left so");
    return;
  }
  require(found == literal(), "a block that counts has a right check sum");
  if (heard == Heard::kComplete) require_sane(out);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const unsigned choice = bytes.next();
  const BusLayout layout = layout_of(choice);
  CanCodec can(layout);
  ModbusCodec modbus(layout);
  std::int64_t now = 0;
  while (!bytes.empty()) {
    if (bytes.next() % 4 == 0)
      decode(bytes, modbus, layout);
    else
      hear(can, layout, frame_from(bytes, layout, now));
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "bus_text/dbc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bus_text/value_meaning.hpp"
#include "plumb/drivers/can_form.hpp"

namespace plumb::drivers {
namespace {

/// The text in quotes. A DBC file has no escape sequences, so quotes and backslashes are replaced.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\\', '/');
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return '"' + text + '"';
}

const char* node(Sender sender) { return sender == Sender::kPlumb ? "plumb_rt" : "controller"; }

class Dbc {
 public:
  explicit Dbc(const BusLayout& layout) : layout_(layout) {}

  std::string write(const std::string& about) {
    line("VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: controller plumb_rt\n");
    each_frame([&](const auto& m, std::size_t i) { frame(m, i); });
    line("CM_ {};", quoted(about));
    each_frame([&](const auto& m, std::size_t i) { comments(m, i); });
    attributes();
    each_frame([&](const auto& m, std::size_t i) { named_numbers(m, i); });
    return std::move(out_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), text, std::forward<Args>(args)...);
    out_ += '\n';
  }

  template <class Do>
  void each_frame(const Do& what) {
    for (const MessageLayout& message : layout_.messages)
      for (std::size_t i = 0; i < can_frames(layout_, message); ++i) what(message, i);
  }

  /// The identifier as a DBC file states it: bit 31 marks an extended identifier of 29 bits.
  std::uint32_t id(const MessageLayout& message, std::size_t i) const {
    const bool extended = layout_.id_kind == CanFrame::Id::kExtended;
    return (message.can_id + static_cast<std::uint32_t>(i)) | (extended ? 0x80000000U : 0U);
  }

  std::string name(const MessageLayout& message, std::size_t i) const {
    return can_frames(layout_, message) == 1 ? message.name
                                             : fmt::format("{}_{}", message.name, i + 1);
  }

  /// The place of a number in its frame, for example "0|24@1-": start bit, number of bits, byte
  /// order (0 is big-endian, and then the start bit is the most significant one) and sign.
  std::string place(int byte, int bytes, char sign) const {
    const bool big = layout_.byte_order == ByteOrder::kBig;
    return fmt::format("{}|{}@{}{}", 8 * byte + (big ? 7 : 0), 8 * bytes, big ? 0 : 1, sign);
  }

  void frame(const MessageLayout& message, std::size_t i) {
    const CanForm form = can_form(layout_, message);
    const char* to = node(message.sender == Sender::kPlumb ? Sender::kController : Sender::kPlumb);
    line("BO_ {} {}: {} {}", id(message, i), name(message, i), form.length, node(message.sender));
    const double most = std::ldexp(1.0, 8 * form.value_bytes - 1) - 1.0;
    each_value(message, i, [&](const Signal& signal, std::size_t k) {
      const double factor = signal.scale / si_per_unit(signal.unit);
      line(" SG_ {} : {} ({:.10g},0) [{:.10g}|{:.10g}] \"{}\" {}", signal.name,
           place(static_cast<int>(k * form.value_bytes), form.value_bytes, '-'), factor,
           -most * factor, most * factor, signal.unit, to);
    });
    unsigned_number("counter", form.counter_byte, form.counter_bytes, to);
    unsigned_number("crc", form.check_byte, form.check_bytes, to);
    line("");
  }

  void unsigned_number(const char* what, int byte, int bytes, const char* to) {
    line(" SG_ {} : {} (1,0) [0|{}] \"\" {}", what, place(byte, bytes, '+'),
         (std::uint64_t{1} << 8 * bytes) - 1, to);
  }

  /// Calls what(signal, k) for every value of frame `i`; k counts the values of the frame from 0.
  template <class Do>
  void each_value(const MessageLayout& message, std::size_t i, const Do& what) {
    const std::size_t values = can_form(layout_, message).values;
    for (std::size_t k = 0; k < values && i * values + k < message.signals.size(); ++k)
      what(message.signals[i * values + k], k);
  }

  void comments(const MessageLayout& message, std::size_t i) {
    line("CM_ BO_ {} {};", id(message, i), quoted(meaning_of(message.kind)));
    each_value(message, i, [&](const Signal& signal, std::size_t) {
      if (const std::string text = meaning_of(message.kind, signal.name); !text.empty())
        line("CM_ SG_ {} {} {};", id(message, i), signal.name, quoted(text));
    });
    line(
        "CM_ SG_ {} crc {};", id(message, i),
        quoted(layout_.can_format == CanFrame::Format::kFd
                   ? "CRC-32P4 over the identifier as four bytes, low byte first, and all before"
                   : "CRC-8H2F over the identifier as four bytes, low byte first, and all before"));
  }

  /// Writes the attributes that bus tools display: bus type, cycle times, and which frames are CAN
  /// FD.
  void attributes() {
    const bool fd = layout_.can_format == CanFrame::Format::kFd;
    line("BA_DEF_ \"BusType\" STRING ;\nBA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;");
    line(
        "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\","
        "\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"reserved\","
        "\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"StandardCAN_FD\","
        "\"ExtendedCAN_FD\";");
    line("BA_DEF_DEF_ \"BusType\" \"CAN\";\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;");
    line("BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";");
    line("BA_ \"BusType\" \"{}\";", fd ? "CAN FD" : "CAN");
    const int format = (fd ? 14 : 0) + (layout_.id_kind == CanFrame::Id::kExtended ? 1 : 0);
    each_frame([&](const MessageLayout& message, std::size_t i) {
      const double ms = std::clamp(std::round(message.period_s * 1e3), 1.0, 65535.0);
      line("BA_ \"GenMsgCycleTime\" BO_ {} {:.0f};", id(message, i), ms);
      line("BA_ \"VFrameFormat\" BO_ {} {};", id(message, i), format);
    });
  }

  void named_numbers(const MessageLayout& message, std::size_t i) {
    const CanForm form = can_form(layout_, message);
    const auto unknown = -(std::int64_t{1} << (8 * form.value_bytes - 1));
    each_value(message, i, [&](const Signal& signal, std::size_t) {
      std::string text =
          fmt::format("VAL_ {} {} {} \"unknown\"", id(message, i), signal.name, unknown);
      for (const auto& [number, word] : names_of(message.kind, signal.name))
        text += fmt::format(" {} \"{}\"", number, word);
      line("{} ;", text);
    });
  }

  const BusLayout& layout_;
  std::string out_;
};

}  // namespace

std::string write_dbc(const BusLayout& layout, const std::string& about) {
  return Dbc(layout).write(about);
}

}  // namespace plumb::drivers

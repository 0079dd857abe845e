// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/session_inputs.hpp"

namespace plumb::drivers {
namespace {

std::string hex(std::uint32_t id) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%X", static_cast<unsigned>(id));
  return text;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f", std::ceil(100.0 * share));
  return text;
}

std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f", number);
  return text;
}

bool is_scale(double scale) { return scale > 0.0 && scale <= 1e3; }
bool is_period(double period_s) { return period_s >= 1e-5 && period_s <= 1e3; }

/// The first and the last identifier, or register, of a message.
struct Span {
  std::uint32_t first, last;
  bool meets(const Span& other) const { return first <= other.last && other.first <= last; }
};

class Faults {
 public:
  Faults(const BusLayout& layout, BusUse use) : layout_(layout), use_(use) {}

  std::vector<LayoutFault> find() {
    for (const MessageLayout& message : layout_.messages) check(message);
    if (use_ == BusUse::kCan) check_rates();
    if (!out_.empty()) return std::move(out_);  // faulty messages have no meaningful spans
    for (std::size_t i = 0; i < layout_.messages.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) check_apart(layout_.messages[j], layout_.messages[i]);
    if (use_ == BusUse::kCan) check_load();
    if (use_ == BusUse::kModbus) check_owner();
    return std::move(out_);
  }

 private:
  void add(const std::string& message, const char* key, std::string what, std::string help) {
    out_.push_back({message, key, std::move(what), std::move(help)});
  }

  Span ids(const MessageLayout& m) const {
    return {m.can_id, m.can_id + static_cast<std::uint32_t>(can_frames(layout_, m)) - 1};
  }
  static Span registers(const MessageLayout& m) {
    return {m.first_register,
            m.first_register + static_cast<std::uint32_t>(modbus_registers(m)) - 1};
  }

  void check(const MessageLayout& m) {
    if (m.signals.empty() || m.signals.size() > kMaxMessageValues) {
      add(m.name, "signals",
          m.name + " has " + std::to_string(m.signals.size()) + " values, not 1 to " +
              std::to_string(kMaxMessageValues),
          "use fewer temperatures");
      return;
    }
    const auto bad = std::find_if(m.signals.begin(), m.signals.end(),
                                  [](const Signal& s) { return !is_scale(s.scale); });
    if (bad != m.signals.end())
      add(m.name, "scale",
          "the scale of " + m.name + "." + bad->name + " is not above 0, or above 1000",
          "a micrometre or microradian a count is usual: 1");
    check_period(m);
    if (use_ == BusUse::kCan) check_id(m);
    if (const Span span = registers(m); span.last > 0xFFFF)
      add(m.name, "register",
          m.name + " ends at register " + std::to_string(span.last) + ", beyond 65535",
          "the last that fits is " + std::to_string(0xFFFF - (span.last - span.first)));
  }

  /// Checks that the period is so short that one lost message does not make its sender count as
  /// silent.
  void check_period(const MessageLayout& m) {
    if (!is_period(m.period_s))
      return add(m.name, "period_us",
                 "the period of " + m.name + " is not between 10 us and 1000 s",
                 "every cycle is usual");
    const double most_us = 0.5e6 * longest_silence_s(m.kind);
    const double period_us = 1e6 * m.period_s;
    if (period_us <= most_us * (1.0 + 1e-9)) return;
    add(m.name, "period_us",
        "every " + rounded(period_us) + " us is too seldom for " + m.name + ": after " +
            rounded(2.0 * most_us) + " us without one its sender counts as silent",
        "at most " + rounded(most_us) + ", of period_us or, without one, of cycle_us");
  }

  void check_id(const MessageLayout& m) {
    const bool standard = layout_.id_kind == CanFrame::Id::kStandard;
    const std::uint32_t most = standard ? 0x7FF : 0x1FFFFFFF;
    const auto frames = static_cast<std::uint32_t>(can_frames(layout_, m));
    if (m.can_id <= most && frames - 1 <= most - m.can_id) return;
    add(m.name, "can_id",
        "the identifiers of " + m.name + ", from " + hex(m.can_id) + ", go beyond " + hex(most),
        standard ? "the last that fits is " + hex(most + 1 - frames) +
                       "; longer ones with id_kind = \"extended\""
                 : "the last that fits is " + hex(most + 1 - frames));
  }

  void check_rates() {
    const bool fd = layout_.can_format == CanFrame::Format::kFd;
    if (!(layout_.bit_rate >= 1e4 && layout_.bit_rate <= 1e6))
      add("", "bit_rate", "the bit rate is not between 10000 and 1000000", "usual: 1000000");
    if (fd && !(layout_.data_bit_rate >= layout_.bit_rate && layout_.data_bit_rate <= 8e6))
      add("", "data_bit_rate", "the data bit rate is not between the bit rate and 8000000",
          "usual: 4000000");
  }

  void check_apart(const MessageLayout& a, const MessageLayout& b) {
    if (use_ == BusUse::kCan && ids(a).meets(ids(b)))
      add(b.name, "can_id",
          b.name + " (" + hex(ids(b).first) + " to " + hex(ids(b).last) + ") and " + a.name + " (" +
              hex(ids(a).first) + " to " + hex(ids(a).last) + ") share identifiers",
          "the next behind " + a.name + " is " + hex(ids(a).last + 1));
    if (registers(a).meets(registers(b)))
      add(b.name, "register",
          b.name + " (" + std::to_string(registers(b).first) + " to " +
              std::to_string(registers(b).last) + ") and " + a.name + " (" +
              std::to_string(registers(a).first) + " to " + std::to_string(registers(a).last) +
              ") share registers",
          "the next behind " + a.name + " is " + std::to_string(registers(a).last + 1));
  }

  void check_owner() {
    if (!layout_.owner_register) return;
    const std::uint32_t first = *layout_.owner_register;
    const Span own{first, first + kOwnerRegisters - 1};
    std::uint32_t free = 0;
    for (const MessageLayout& m : layout_.messages) free = std::max(free, registers(m).last + 1);
    const auto taken =
        std::find_if(layout_.messages.begin(), layout_.messages.end(),
                     [&](const MessageLayout& m) { return registers(m).meets(own); });
    const std::string help = "behind all messages is " + std::to_string(free) +
                             "; 0 if the controller has no register for it";
    if (own.last > 0xFFFF)
      add("", "owner_register", "the owner's number ends beyond register 65535", help);
    else if (taken != layout_.messages.end())
      add("", "owner_register",
          "the owner's number (" + std::to_string(own.first) + " to " + std::to_string(own.last) +
              ") and " + taken->name + " share registers",
          help);
  }

  void check_load() {
    const double load = worst_bus_load(layout_);
    if (load <= kMostBusLoad) return;
    add("", "load",
        "at worst the messages take " + percent(load) + " % of the bus; at most " +
            percent(kMostBusLoad) + " % is safe",
        layout_.can_format == CanFrame::Format::kFd
            ? "raise data_bit_rate, or lengthen cycle_us or the periods of single messages"
            : "can_format = \"fd\", correction = \"offset\", or a longer cycle_us");
  }

  const BusLayout& layout_;
  BusUse use_;
  std::vector<LayoutFault> out_;
};

}  // namespace

std::vector<LayoutFault> find_faults(const BusLayout& layout, BusUse use) {
  return Faults(layout, use).find();
}

}  // namespace plumb::drivers

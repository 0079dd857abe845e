// SPDX-License-Identifier: Apache-2.0
#include "bus_text/layout_toml.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

#include "bus_text/layout_message_toml.hpp"
#include "plumb/format/limits.hpp"

namespace plumb::drivers {
namespace {

constexpr std::array kKinds{MessageKind::kJoints,  MessageKind::kCommanded,  MessageKind::kTarget,
                            MessageKind::kActual,  MessageKind::kController, MessageKind::kRobot,
                            MessageKind::kContext, MessageKind::kCorrected,  MessageKind::kOffset,
                            MessageKind::kStatus,  MessageKind::kSignature};
static_assert(kKinds.size() == kMessageKinds);

MessageLayout* find(BusLayout& layout, MessageKind kind) {
  for (MessageLayout& message : layout.messages)
    if (message.kind == kind) return &message;
  return nullptr;
}

void read_wire(TomlTable& bus, BusLayout& layout) {
  if (bus.choice("can_format", {"classic", "fd"}) == "fd")
    layout.can_format = CanFrame::Format::kFd;
  if (bus.choice("id_kind", {"standard", "extended"}) == "extended")
    layout.id_kind = CanFrame::Id::kExtended;
  if (bus.choice("byte_order", {"little", "big"}) == "big") layout.byte_order = ByteOrder::kBig;
  if (bus.choice("word_order", {"big", "little"}) == "little")
    layout.word_order = ByteOrder::kLittle;
  layout.bit_rate = bus.number_or("bit_rate", layout.bit_rate);
  layout.data_bit_rate = bus.number_or("data_bit_rate", layout.data_bit_rate);
}

/// The message a table is of; null, and reported, if the layout has none. Asking adds `commanded`.
MessageLayout* message_for(TomlTable& bus, const std::string& name, MessageKind kind,
                           const BusArm& arm, BusLayout& layout) {
  if (MessageLayout* const found = find(layout, kind)) return found;
  if (kind == MessageKind::kCommanded) {
    layout.messages.push_back(arm_message(arm, kind));
    return &layout.messages.back();
  }
  const bool offset = kind == MessageKind::kOffset;
  bus.error(bus.source().code("BUS"),
            fmt::format("'{}': there is no such message while correction = \"{}\"", bus.name(name),
                        offset ? "pose" : "offset"),
            *bus.node(name), "not sent",
            fmt::format("delete it, or: correction = \"{}\"", offset ? "offset" : "pose"));
  return nullptr;
}

void read_messages(TomlTable& bus, const BusArm& arm, BusLayout& layout) {
  for (const MessageKind kind : kKinds) {
    const std::string name = name_of(kind);
    auto table = bus.table(name);
    if (!table) continue;
    if (MessageLayout* const message = message_for(bus, name, kind, arm, layout))
      read_message(*table, *message);
  }
}

const char* word(ByteOrder order) { return order == ByteOrder::kBig ? "big" : "little"; }

/// What a count of that unit is [1e-6 SI]; 0: the message has no such value.
double count_of(const MessageLayout& message, const std::string& unit) {
  for (const Signal& signal : message.signals)
    if (signal.unit == unit) return signal.scale / si_per_unit(unit);
  return 0.0;
}

std::size_t temperatures_of(const BusLayout& layout) {
  const MessageLayout* const context = layout.find(MessageKind::kContext);
  if (context == nullptr) return 0;
  std::size_t out = 0;
  for (const Signal& signal : context->signals) out += signal.unit == "degC" ? 1 : 0;
  return out;
}

std::string write_message(const MessageLayout& message, const std::string& path) {
  std::string out = fmt::format(
      "\n[{}.{}]   # from {}\ncan_id = 0x{:X}\nregister = {}\nperiod_us = {:.10g}\n", path,
      message.name, message.sender == Sender::kPlumb ? "plumb-rt" : "the controller",
      message.can_id, message.first_register, message.period_s * 1e6);
  for (const char* unit : {"um", "urad"})
    if (const double count = count_of(message, unit); count > 0.0)
      out += fmt::format("count_{} = {:.10g}\n", unit, count);
  return out;
}

}  // namespace

void report_fault(TomlTable& bus, const LayoutFault& fault) {
  const std::string key = fault.key == "scale" ? "count_um" : fault.key;
  const auto at = [&](TomlTable& table) {
    const toml::node* node = table.node(key);
    return node != nullptr ? bus.source().place(node->source(), "here") : table.place("here");
  };
  Place place = bus.place("here");
  if (fault.message.empty())
    place = at(bus);
  else if (auto table = bus.table(fault.message))
    place = at(*table);
  bus.source().problems().error(bus.source().code("BUS"), fault.what, std::move(place), fault.help);
}

BusLayout read_bus(TomlTable& bus, const BusArm& arm, BusUse use) {
  const std::size_t before = bus.source().problems().errors().size();
  const auto temperatures = whole_number(bus, "temperatures", 0, format::kMaxTemperatures);
  const bool offset = bus.choice("correction", {"pose", "offset"}) == "offset";
  BusLayout out = arm_layout(arm, static_cast<int>(temperatures.value_or(0)),
                             offset ? CorrectionForm::kOffset : CorrectionForm::kPose);
  read_wire(bus, out);
  read_messages(bus, arm, out);
  bus.done();
  if (bus.source().problems().errors().size() == before)
    for (const LayoutFault& fault : find_faults(out, use)) report_fault(bus, fault);
  return out;
}

std::string write_bus(const BusLayout& layout, const std::string& path) {
  const bool fd = layout.can_format == CanFrame::Format::kFd;
  std::string out = fmt::format("[{}]\n", path);
  out += fmt::format("can_format = \"{}\"   # \"classic\" or \"fd\"\n", fd ? "fd" : "classic");
  out += fmt::format("id_kind = \"{}\"   # \"standard\" or \"extended\"\n",
                     layout.id_kind == CanFrame::Id::kStandard ? "standard" : "extended");
  out += fmt::format("byte_order = \"{}\"   # in CAN frames\n", word(layout.byte_order));
  out += fmt::format("word_order = \"{}\"   # of the two registers of a Modbus value\n",
                     word(layout.word_order));
  out += fmt::format("correction = \"{}\"   # \"pose\" or \"offset\"\n",
                     layout.correction == CorrectionForm::kPose ? "pose" : "offset");
  out += fmt::format("bit_rate = {:.10g}\n", layout.bit_rate);
  out += fmt::format("data_bit_rate = {:.10g}   # of CAN FD\n", layout.data_bit_rate);
  out += fmt::format("temperatures = {}   # sensors that the controller reports\n",
                     temperatures_of(layout));
  for (const MessageLayout& message : layout.messages) out += write_message(message, path);
  return out;
}

}  // namespace plumb::drivers

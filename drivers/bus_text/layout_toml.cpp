// SPDX-License-Identifier: Apache-2.0
#include "bus_text/layout_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bus_text/layout_message_toml.hpp"
#include "plumb/drivers/sensor_places.hpp"
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

void read_owner(TomlTable& bus, MissingOwner missing, BusLayout& layout) {
  if (bus.node("owner_register") == nullptr) {
    if (missing == MissingOwner::kNone) layout.owner_register.reset();
    return;
  }
  const auto first = whole_number(bus, "owner_register", 0, 0xFFFF);
  layout.owner_register.reset();
  if (first && *first > 0) layout.owner_register = static_cast<std::uint16_t>(*first);
}

/// The message that a table describes. A table for `commanded` adds that message to the layout. If
/// the layout cannot have the message, the result is null and the table is reported.
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

/// The size of one count of the values in that unit [1e-6 SI], or 0 if the message has no such
/// value.
double count_of(const MessageLayout& message, const std::string& unit) {
  for (const Signal& signal : message.signals)
    if (signal.unit == unit) return signal.scale / si_per_unit(unit);
  return 0.0;
}

/// True if the name is one that measurement files allow ("temp", "temp_elbow") and has at most the
/// 32 characters that a DBC file allows.
bool is_sensor(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
  return plain && name.size() <= 32 && (name == "temp" || name.starts_with("temp_"));
}

std::vector<std::string> named_temperatures(TomlTable& bus) {
  const auto refuse = [&](const toml::node& at, const std::string& what) {
    bus.error(bus.source().code("RANGE"), what, at, "here",
              fmt::format("at most {} sensors, as measurements.csv names them without _degC: "
                          "[\"temp\", \"temp_elbow\"]",
                          format::kMaxTemperatures));
  };
  std::vector<std::string> out;
  for (const auto& [name, node] : bus.texts("temperatures")) {
    const bool twice = std::find(out.begin(), out.end(), name) != out.end();
    if (twice || !is_sensor(name))
      refuse(*node, fmt::format("'{}' is {}", name, twice ? "listed twice" : "no sensor's name"));
    out.push_back(name);
  }
  if (out.size() > format::kMaxTemperatures)
    refuse(*bus.node("temperatures"), "more temperatures than a model can read");
  return out;
}

/// The temperatures that the controller reports, given either by their number or by their names.
struct Temperatures {
  int count = 0;
  std::vector<std::string> names;
};
Temperatures read_temperatures(TomlTable& bus) {
  const toml::node* const node = bus.node("temperatures");
  if (node == nullptr || !node->is_array()) {
    const auto count = whole_number(bus, "temperatures", 0, format::kMaxTemperatures);
    return {.count = static_cast<int>(count.value_or(0)), .names = {}};
  }
  auto names = named_temperatures(bus);
  const auto most = static_cast<std::size_t>(format::kMaxTemperatures);
  const auto count = static_cast<int>(std::min(names.size(), most));
  return {.count = count, .names = std::move(names)};
}

std::string write_temperatures(const BusLayout& layout) {
  const auto names = temperature_names(layout);
  if (!are_named(names)) return fmt::format("{}", names.size());
  return fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
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

BusLayout read_bus(TomlTable& bus, const BusArm& arm, BusUse use, MissingOwner owner) {
  const std::size_t before = bus.source().problems().errors().size();
  const Temperatures temperatures = read_temperatures(bus);
  const bool offset = bus.choice("correction", {"pose", "offset"}) == "offset";
  BusLayout out =
      arm_layout(arm, temperatures.count, offset ? CorrectionForm::kOffset : CorrectionForm::kPose);
  name_temperatures(temperatures.names, out);
  read_wire(bus, out);
  read_owner(bus, owner, out);
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
  out += fmt::format("owner_register = {}   # of plumb-rt's number as Modbus client; 0: none\n",
                     layout.owner_register.value_or(0));
  out += fmt::format("bit_rate = {:.10g}\n", layout.bit_rate);
  out += fmt::format("data_bit_rate = {:.10g}   # of CAN FD\n", layout.data_bit_rate);
  out += fmt::format("temperatures = {}   # sensors that the controller reports\n",
                     write_temperatures(layout));
  for (const MessageLayout& message : layout.messages) out += write_message(message, path);
  return out;
}

}  // namespace plumb::drivers

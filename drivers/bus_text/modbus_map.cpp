// SPDX-License-Identifier: Apache-2.0
#include "bus_text/modbus_map.hpp"

#include <fmt/format.h>

#include "bus_text/value_meaning.hpp"

namespace plumb::drivers {
namespace {

struct Row {
  unsigned first = 0;
  unsigned count = 0;
  std::string value, type, unit, meaning;
  double factor = 1.0;
};

std::string meaning(const MessageLayout& message, const Signal& signal) {
  std::string out = meaning_of(message.kind, signal.name);
  for (const auto& [number, name] : names_of(message.kind, signal.name))
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", number, name);
  return out;
}

std::vector<Row> rows_of(const MessageLayout& message) {
  std::vector<Row> out;
  unsigned at = message.first_register;
  for (const Signal& signal : message.signals) {
    out.push_back({at, 2, signal.name, "int32", signal.unit, meaning(message, signal),
                   signal.scale / si_per_unit(signal.unit)});
    at += 2;
  }
  out.push_back({at, 1, "counter", "uint16", "", "Of the cycle", 1.0});
  out.push_back({at + 1, 2, "crc", "uint32", "", "CRC-32P4 of this block", 1.0});
  return out;
}

constexpr const char* kOwnerMeaning =
    "Random number of the plumb-rt that writes here; 0: none has begun";

std::string owner_section(const BusLayout& layout) {
  if (!layout.owner_register) return "";
  return fmt::format(
      "\n## owner\n\n"
      "The number by which plumb-rt, as Modbus client, knows its registers again. It writes it "
      "once, before all else: {} registers\nfrom {}, without a check sum.\n\n"
      "| register | value | type | unit | factor | |\n|---|---|---|---|---|---|\n"
      "| {} | token | uint32 |  | 1 | {} |\n",
      kOwnerRegisters, *layout.owner_register, *layout.owner_register, kOwnerMeaning);
}

const char* sender(const MessageLayout& message) {
  return message.sender == Sender::kPlumb ? "plumb-rt" : "controller";
}

std::string section(const MessageLayout& message) {
  std::string out = fmt::format(
      "\n## {}\n\n{}. Written by {} every {:.10g} µs: {} registers from {}.\n\n"
      "| register | value | type | unit | factor | |\n|---|---|---|---|---|---|\n",
      message.name, meaning_of(message.kind),
      message.sender == Sender::kPlumb ? "plumb-rt" : "the controller", message.period_s * 1e6,
      modbus_registers(message), message.first_register);
  for (const Row& row : rows_of(message))
    out += fmt::format("| {} | {} | {} | {} | {:.10g} | {} |\n", row.first, row.value, row.type,
                       row.unit, row.factor, row.meaning);
  return out;
}

}  // namespace

std::string modbus_map_markdown(const BusLayout& layout, const std::string& about) {
  const bool big = layout.word_order == ByteOrder::kBig;
  std::string out = fmt::format(
      "# Modbus map: {}\n\n"
      "Holding registers, counted from 0 (register 0 is 40001 where counting begins there). A "
      "value "
      "is the number times the\nfactor. Of two registers the first holds the {} word. -2147483648 "
      "is \"unknown\". Positions and rotation vectors\nare in the base frame. Read and write a "
      "message in one request.\n\n"
      "The check sum of a message is CRC-32P4 (polynomial 0xF4ACFB13, reflected, start and final "
      "xor "
      "0xFFFFFFFF) over the\nmessage's first register number as four bytes, low byte first, then "
      "every register before the check sum, high byte\nfirst.\n\n"
      "The registers that plumb-rt writes must keep what was written, and be readable. It compares "
      "them before every\nwrite: nobody else may write them, but a controller that starts may zero "
      "them.\n",
      about, big ? "high" : "low");
  for (const MessageLayout& message : layout.messages) out += section(message);
  return out + owner_section(layout);
}

std::string modbus_map_csv(const BusLayout& layout) {
  std::string out = "register,registers,message,value,type,unit,factor,sender,period_us,meaning\n";
  for (const MessageLayout& message : layout.messages)
    for (const Row& row : rows_of(message))
      out += fmt::format("{},{},{},{},{},{},{:.10g},{},{:.10g},\"{}\"\n", row.first, row.count,
                         message.name, row.value, row.type, row.unit, row.factor, sender(message),
                         message.period_s * 1e6, row.meaning);
  if (layout.owner_register)
    out += fmt::format("{},{},owner,token,uint32,,1,plumb-rt,0,\"{}\"\n", *layout.owner_register,
                       kOwnerRegisters, kOwnerMeaning);
  return out;
}

}  // namespace plumb::drivers

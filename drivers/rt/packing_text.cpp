// SPDX-License-Identifier: Apache-2.0
#include "rt/packing_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace plumb::drivers::rt {
namespace {

using Words = RegisterPacking::Words;
using Sum = RegisterPacking::Sum;

std::vector<std::string> differences(const RegisterPacking& packing, int there) {
  std::vector<std::string> out;
  if (packing.words == Words::kAll) out.emplace_back("the two registers of each number swapped");
  if (packing.words == Words::kValues)
    out.emplace_back("the two registers of each value swapped, but not those of the check sum");
  if (packing.bytes_swapped) out.emplace_back("the two bytes of each register swapped");
  if (packing.shift != 0)
    out.push_back(fmt::format("every register one {}, {} at {}",
                              packing.shift > 0 ? "further on" : "further back",
                              name_of(packing.kind), there));
  return out;
}

/// True if a layout can say it: the check sum is then formed as plumb-rt would form it.
bool is_for_layout(const RegisterPacking& packing) {
  return packing.words != Words::kValues && !packing.bytes_swapped &&
         packing.sum_content == Sum::kAsSent && packing.sum_address == Sum::kAsSent;
}

std::string keys(const RegisterPacking& packing, const BusLayout& layout, int there) {
  std::vector<std::string> out;
  if (packing.words != Words::kAsLaidOut)
    out.push_back(fmt::format("word_order = \"{}\" into [bus]",
                              layout.word_order == ByteOrder::kBig ? "little" : "big"));
  if (packing.shift != 0)
    out.push_back(fmt::format("register = {} into [bus.{}]{}", there, name_of(packing.kind),
                              packing.alone ? "" : ", and so on for every message"));
  return fmt::format("{}", fmt::join(out, " and "));
}

}  // namespace

std::string packing_text(const RegisterPacking& packing, const BusLayout& layout) {
  const MessageLayout* const message = layout.find(packing.kind);
  if (!packing.any() || message == nullptr) return "";
  const int there = message->first_register + packing.shift;
  const std::string whose = packing.alone
                                ? fmt::format("check sum of message {} holds", message->name)
                                : "check sums of the controller's messages hold";
  const std::string what =
      fmt::format("the {} with {}", whose, fmt::join(differences(packing, there), " and "));
  if (!is_for_layout(packing))
    return what + ": change the controller's program; no key of rt.toml stands for it";
  return fmt::format(
      "{}: change the controller's program, or write {} of rt.toml and seal the "
      "folder (plumb-rt seal)",
      what, keys(packing, layout, there));
}

}  // namespace plumb::drivers::rt

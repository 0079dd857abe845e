// SPDX-License-Identifier: Apache-2.0
#include "rt/lost_words.hpp"

#include <fmt/format.h>

namespace plumb::drivers::rt {
namespace {

/// The name of an exception code in the Modbus specification.
const char* name_of_exception(std::uint32_t exception) {
  switch (exception) {
    case 1:
      return "illegal function";
    case 2:
      return "illegal data address";
    case 3:
      return "illegal data value";
    case 4:
      return "server device failure";
    case 5:
      return "acknowledge";
    case 6:
      return "server device busy";
    case 8:
      return "memory parity error";
    case 10:
      return "gateway path unavailable";
    case 11:
      return "gateway target failed to respond";
    default:
      return "not of the specification";
  }
}

}  // namespace

std::vector<const char*> lost_words(Lost set) {
  std::vector<const char*> out;
  for (int i = 0; i < kLostBits; ++i) {
    const auto one = static_cast<Lost>(1U << static_cast<unsigned>(i));
    if (has(set, one)) out.push_back(to_string(one));
  }
  return out;
}

std::string refusal_text(const WriteRefusal& refusal) {
  if (!refusal.any()) return "";
  return fmt::format("registers {} to {}: exception {}, {}", refusal.first,
                     refusal.first + refusal.count - 1, refusal.exception,
                     name_of_exception(refusal.exception));
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "bus_text/layout_message_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::drivers {
namespace {

constexpr double kMicro = 1e-6;

/// Reads the size of one count for the values in that unit. A message without such values has no
/// such key, so that the key is reported as unknown.
void read_count(TomlTable& table, const std::string& unit, MessageLayout& message) {
  const bool has = std::any_of(message.signals.begin(), message.signals.end(),
                               [&](const Signal& s) { return s.unit == unit; });
  if (!has) return;
  const auto count = table.number("count_" + unit);
  if (!count) return;
  for (Signal& signal : message.signals)
    if (signal.unit == unit) signal.scale = *count * kMicro;
}

}  // namespace

std::optional<std::uint32_t> whole_number(TomlTable& table, const std::string& key,
                                          std::uint32_t least, std::uint32_t most) {
  const auto value = table.number(key);
  if (!value) return std::nullopt;
  if (*value >= least && *value <= most && *value == std::floor(*value))
    return static_cast<std::uint32_t>(*value);
  table.out_of_range(key, fmt::format("a whole number from {} to {}", least, most));
  return std::nullopt;
}

void read_message(TomlTable& table, MessageLayout& message) {
  if (const auto id = whole_number(table, "can_id", 0, 0x1FFFFFFF)) message.can_id = *id;
  if (const auto first = whole_number(table, "register", 0, 0xFFFF))
    message.first_register = static_cast<std::uint16_t>(*first);
  if (const auto period = table.number("period_us")) message.period_s = *period * kMicro;
  read_count(table, "um", message);
  read_count(table, "urad", message);
  table.done();
}

}  // namespace plumb::drivers

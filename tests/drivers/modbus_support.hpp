// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_message.hpp"

namespace plumb::tests {

/// Signal i of a message is 7 times the message's counter plus i, in counts of the wire: a value
/// from elsewhere, or of two moments, is seen to be wrong.
inline double lawful_count(std::uint16_t counter, std::size_t i) {
  return 7.0 * counter + static_cast<double>(i);
}

inline drivers::BusMessage lawful(const drivers::BusLayout& layout, drivers::MessageKind kind,
                                  std::uint16_t counter) {
  const auto& signals = layout.find(kind)->signals;
  drivers::BusMessage out{.kind = kind};
  out.size = static_cast<std::uint8_t>(signals.size());
  out.counter = counter;
  for (std::size_t i = 0; i < signals.size(); ++i)
    out.values[i] = lawful_count(counter, i) * signals[i].scale;
  return out;
}

inline bool is_lawful(const drivers::BusLayout& layout, const drivers::BusMessage& message) {
  const auto* entry = layout.find(message.kind);
  if (entry == nullptr || entry->signals.size() != message.size) return false;
  for (std::size_t i = 0; i < message.size; ++i) {
    const double count = message.values[i] / entry->signals[i].scale;
    if (!(std::abs(count - lawful_count(message.counter, i)) < 0.5)) return false;
  }
  return true;
}

/// False: it did not come true in time.
inline bool soon(const std::function<bool()>& done,
                 std::chrono::milliseconds patience = std::chrono::seconds(10)) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace plumb::tests

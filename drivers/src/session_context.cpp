// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_context.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::drivers {
namespace {

constexpr std::size_t kFirstTemperature = 5;  // after payload, centre of mass and time

/// The reading of a value, or an empty reading if the value is not known.
Reading reading(double value, double age_s) noexcept {
  return std::isfinite(value) ? Reading{.value = value, .age_s = age_s} : Reading{};
}

}  // namespace

ContextReadings context_in(const SessionInbox& inbox, const SensorPlaces& sensors) noexcept {
  ContextReadings out;
  if (!inbox.came(MessageKind::kContext)) return out;
  const BusMessage& message = inbox.last(MessageKind::kContext);
  const double age_s = inbox.age_s(MessageKind::kContext);
  out.payload_kg = reading(message.values[0], age_s);
  std::copy_n(message.values.begin() + 1, out.payload_com_m.size(), out.payload_com_m.begin());
  out.time_s = reading(message.values[4], age_s);
  for (std::size_t k = 0; k < out.temperature_degC.size(); ++k) {
    const std::size_t at = kFirstTemperature + static_cast<std::size_t>(std::max(0, +sensors[k]));
    if (sensors[k] >= 0 && at < message.size)
      out.temperature_degC[k] = reading(message.values[at], age_s);
  }
  return out;
}

}  // namespace plumb::drivers

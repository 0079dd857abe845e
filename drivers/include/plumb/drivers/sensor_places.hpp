// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/format/model.hpp"

namespace plumb::drivers {

/// For each temperature sensor, in the model's order, the index of its temperature in message
/// context; -1 if the message does not contain it.
using SensorPlaces = std::array<std::int8_t, format::kMaxTemperatures>;

/// The places if the temperatures of the message have no names: they are then in the model's order.
constexpr SensorPlaces sensors_in_order() noexcept {
  SensorPlaces out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<std::int8_t>(k);
  return out;
}

/// The signal names of the temperatures in message context. "t1", "t2", .. do not count as names,
/// see are_named().
std::vector<std::string> temperature_names(const BusLayout& layout);
bool are_named(const std::vector<std::string>& temperatures);

/// Gives these names to the first temperatures of message context.
void name_temperatures(const std::vector<std::string>& names, BusLayout& layout);

/// The places by name if the temperatures of the layout are named, else in order. For the load
/// phase.
SensorPlaces sensor_places(const BusLayout& layout, const format::Model& model);

/// Names of the sensors that the model reads but the message does not contain; the model uses their
/// fallbacks.
std::vector<std::string> sensors_missing(const BusLayout& layout, const format::Model& model);

}  // namespace plumb::drivers

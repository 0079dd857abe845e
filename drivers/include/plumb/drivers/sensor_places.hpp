// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/format/model.hpp"

namespace plumb::drivers {

/// For each temperature sensor of a model, as the model counts them, which temperature of the
/// context message it is; -1: the message has it not.
using SensorPlaces = std::array<std::int8_t, format::kMaxTemperatures>;

/// A message whose temperatures have no names has them as the model counts.
constexpr SensorPlaces sensors_in_order() noexcept {
  SensorPlaces out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<std::int8_t>(k);
  return out;
}

/// The temperatures of message context; "t1", "t2", .. are no names.
std::vector<std::string> temperature_names(const BusLayout& layout);
bool are_named(const std::vector<std::string>& temperatures);

/// Gives the first of them these names.
void name_temperatures(const std::vector<std::string>& names, BusLayout& layout);

/// By name where the layout has names. Load phase.
SensorPlaces sensor_places(const BusLayout& layout, const format::Model& model);

/// The sensors that the model reads and the message does not bring; the model then goes by its
/// fallback.
std::vector<std::string> sensors_missing(const BusLayout& layout, const format::Model& model);

}  // namespace plumb::drivers

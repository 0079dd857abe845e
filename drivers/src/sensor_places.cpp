// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/sensor_places.hpp"

#include <algorithm>

#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb::drivers {
std::vector<std::string> temperature_names(const BusLayout& layout) {
  std::vector<std::string> out;
  if (const MessageLayout* const context = layout.find(MessageKind::kContext))
    for (const Signal& signal : context->signals)
      if (signal.unit == "degC") out.push_back(signal.name);
  return out;
}

bool are_named(const std::vector<std::string>& temperatures) {
  for (std::size_t k = 0; k < temperatures.size(); ++k)
    if (temperatures[k] != "t" + std::to_string(k + 1)) return true;
  return false;
}

void name_temperatures(const std::vector<std::string>& names, BusLayout& layout) {
  auto next = names.begin();
  for (MessageLayout& message : layout.messages)
    for (Signal& signal : message.signals)
      if (signal.unit == "degC" && next != names.end()) signal.name = *next++;
}

SensorPlaces sensor_places(const BusLayout& layout, const format::Model& model) {
  const auto brought = temperature_names(layout);
  SensorPlaces out = sensors_in_order();
  if (!are_named(brought)) return out;
  out.fill(-1);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::string* const sensor = temperature_name(model, static_cast<int>(k));
    if (sensor == nullptr) break;
    const auto found = std::find(brought.begin(), brought.end(), *sensor);
    if (found != brought.end()) out[k] = static_cast<std::int8_t>(found - brought.begin());
  }
  return out;
}

std::vector<std::string> sensors_missing(const BusLayout& layout, const format::Model& model) {
  const auto brought = static_cast<int>(temperature_names(layout).size());
  const SensorPlaces places = sensor_places(layout, model);
  std::vector<std::string> out;
  for (int k = 0; k < format::kMaxTemperatures; ++k) {
    const std::string* const sensor = temperature_name(model, k);
    if (sensor == nullptr) break;
    // NOLINTNEXTLINE(bugprone-signed-char-misuse): a number, no character
    const int place = places[static_cast<std::size_t>(k)];
    if (place < 0 || place >= brought) out.push_back(*sensor);
  }
  return out;
}

}  // namespace plumb::drivers

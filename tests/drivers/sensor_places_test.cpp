// SPDX-License-Identifier: Apache-2.0
// A model finds its sensors in message context by their names, or by their order where it has none.
#include "plumb/drivers/sensor_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plumb/drivers/session_context.hpp"
#include "tests/rt/warm_arm.hpp"

namespace plumb::drivers {
namespace {

using Names = std::vector<std::string>;

BusLayout bus_with(const Names& names) {
  BusLayout out = default_layout(6, 0.004, static_cast<int>(names.size()));
  name_temperatures(names, out);
  return out;
}

TEST(SensorPlaces, AreByNameWhereTheBusHasNames) {
  const auto model = tests::warm_arm({"temp", "temp_elbow", "temp_room"});
  const SensorPlaces places = sensor_places(bus_with({"temp_room", "temp", "temp_x"}), model);
  EXPECT_EQ(places, (SensorPlaces{1, -1, 0, -1, -1, -1, -1, -1}));
  EXPECT_EQ(sensors_missing(bus_with({"temp_room", "temp", "temp_x"}), model), Names{"temp_elbow"});
}

TEST(SensorPlaces, AreByOrderWhereTheBusOnlyCounts) {
  const auto model = tests::warm_arm({"temp", "temp_elbow", "temp_room"});
  const BusLayout counted = default_layout(6, 0.004, 2);
  EXPECT_EQ(sensor_places(counted, model), sensors_in_order());
  EXPECT_EQ(sensors_missing(counted, model), Names{"temp_room"});
  EXPECT_EQ(sensors_missing(default_layout(6, 0.004), model).size(), 3U);
  EXPECT_EQ(sensors_missing(counted, tests::warm_arm({})), Names{});
}

TEST(SensorPlaces, TakeEachReadingFromItsPlaceAndNoneThatTheMessageHasNot) {
  SessionInbox inbox;
  BusMessage message{.kind = MessageKind::kContext, .size = 7};
  for (std::size_t i = 0; i < message.size; ++i) message.values[i] = 20.0 + static_cast<double>(i);
  message.time_ns = 1;
  inbox.hear(message);
  inbox.step(1, 0.0);
  const auto readings = context_in(inbox, {1, -1, 0, 2, 7, -1, -1, -1}).temperature_degC;
  EXPECT_EQ(readings[0].value, 26.0);
  EXPECT_EQ(readings[2].value, 25.0);
  for (const std::size_t none : {1U, 3U, 4U, 5U}) EXPECT_TRUE(std::isnan(readings[none].value));
}

}  // namespace
}  // namespace plumb::drivers

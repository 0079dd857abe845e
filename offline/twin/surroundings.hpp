// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "twin/path.hpp"
#include "twin/twin_file.hpp"

namespace plumb::offline::twin {

/// The influences on the arm besides its joint positions, and what the controller's sensors tell of
/// them. A path takes the arm through two hours of the simulator's climate, however fast it is
/// driven: the station with index k of n is visited after k / n of that time.

struct Temperature {
  std::string sensor;
  double degC;
};

/// What the controller knows at a station.
struct Readings {
  Payload payload;
  double time_s = 0.0;  // since the two hours began
  std::vector<Temperature> temperatures;
};

/// The readings at every station. Throws Failure (kInput, E-TWIN-SENSOR) for an unknown sensor.
std::vector<Readings> readings_along(const Cell& cell, const Hidden& hidden,
                                     const HiddenTruth& truth, const Path& path);

/// The context message of this layout. Each value is found by its name; temperatures without names
/// follow the order of the readings. A value without a reading is NaN.
drivers::BusMessage context_message(const drivers::MessageLayout& layout, const Readings& now,
                                    std::uint16_t counter);

/// The plan that simulates the arm, without the effects of the measurement, at the first stations
/// of a path of `stations` stations.
SimulationPlan visits_of(const HiddenTruth& truth, const RowsN& q, int stations);

/// True if the size of any of these effects depends on a temperature.
bool needs_temperatures(const std::vector<HiddenEffect>& effects);

}  // namespace plumb::offline::twin

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "twin/path.hpp"
#include "twin/twin_file.hpp"

namespace plumb::offline::twin {

/// What moves the arm besides its joints, and what the controller's own sensors say of it. A path
/// takes the arm through two hours of the simulator's climate, however fast it is driven: station k
/// of n is visited when k n-ths of them are over.

struct Temperature {
  std::string sensor;
  double degC;
};

/// What the controller knows at a station.
struct Readings {
  Payload payload;
  double time_s = 0.0;  // since those hours began
  std::vector<Temperature> temperatures;
};

/// One for every station. Throws Failure (kInput, E-TWIN-SENSOR) for a sensor that the arm has not.
std::vector<Readings> readings_along(const Cell& cell, const Hidden& hidden,
                                     const HiddenTruth& truth, const Path& path);

/// kContext as the layout has it, value by value by their names, temperatures that have none in the
/// order of the readings; NaN: there is no such reading.
drivers::BusMessage context_message(const drivers::MessageLayout& layout, const Readings& now,
                                    std::uint16_t counter);

/// The arm, and not its measurement, at the first rows of a path of `stations` stations.
SimulationPlan visits_of(const HiddenTruth& truth, const RowsN& q, int stations);

/// There are effects whose size follows a temperature.
bool needs_temperatures(const std::vector<HiddenEffect>& effects);

}  // namespace plumb::offline::twin

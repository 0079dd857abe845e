// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/bus_port.hpp"
#include "program/outcome.hpp"
#include "twin/controller.hpp"
#include "twin/tracker.hpp"

namespace plumb::offline::twin {

/// Adds to the result the member `loop`, and to the text its lines: what the controller saw of
/// plumb-rt and of the bus. Reports an error (kBusLost) if the controller waited for corrections in
/// vain.
void add_loop(const Controller& controller, const drivers::PortCounters& port, std::uint64_t missed,
              Outcome& outcome);

/// Adds to the result the member `stops`: for each stop its time, its error and the correction that
/// was applied.
void add_stops(const std::vector<Stop>& stops, const TrueErrors& errors, Outcome& outcome);

}  // namespace plumb::offline::twin

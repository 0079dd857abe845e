// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "plumb/drivers/bus_port.hpp"
#include "rt/deployment.hpp"

namespace plumb::drivers::rt {

/// A bus that is open, with whatever stands behind its port.
class OpenBus {
 public:
  virtual ~OpenBus() = default;
  virtual BusPort& port() noexcept = 0;

  /// Now and then, by a thread that may wait: helps a link that is down to come back.
  virtual void tend() noexcept {}

  /// There will be no further target.
  virtual bool finished() const noexcept { return false; }
};

/// Opens what [source] names. Throws Failure: E-RT-LINK (kEnvironment) with the system's reason,
/// E-RT-CSV (kInput). Nothing is sent yet. Slow.
std::unique_ptr<OpenBus> open_bus(const Deployment& deployment);

/// The interface as the record names it: "can0", "modbus", "csv".
std::string bus_name(const SourceConfig& source);

/// The layout that the record is written in: of the bus if that is CAN, else its FD variant, which
/// loses nothing of what other buses carry.
BusLayout record_layout(const Deployment& deployment);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "cell/cell.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "twin/fault.hpp"
#include "twin/ports.hpp"

namespace plumb::offline::twin {

/// Which bus the controller speaks on, as the command line says it.
struct LinkChoice {
  std::string can;              // "vcan0"
  std::string modbus;           // "host:port": plumb-rt is the server, we ask
  std::string modbus_serve;     // "address:port": plumb-rt asks, we are the server
  std::string rtu;              // device
  std::string role = "server";  // ours on the serial line
  int unit = 1;
  int baud = 115200;

  bool any() const {
    return !(can.empty() && modbus.empty() && modbus_serve.empty() && rtu.empty());
  }
  bool is_can() const { return !can.empty(); }
};

/// The layout of `file`: [bus] of an rt.toml or [deploy.bus] of a cell.toml; without such a table
/// the default. Throws Failure (kInput).
drivers::BusLayout read_layout(const Cell& cell, const std::filesystem::path& file,
                               drivers::BusUse use);

/// An open bus with whatever stands behind its port.
class Link {
 public:
  virtual ~Link() = default;
  virtual drivers::BusPort& port() noexcept = 0;
  /// Now and then: helps a link that is down to come back. May wait.
  virtual void tend() noexcept {}
};

/// Throws Failure (kEnvironment, E-TWIN-BUS) with the system's reason. `plan` and `time` outlive
/// it.
std::unique_ptr<Link> open_link(const LinkChoice& choice, const drivers::BusLayout& layout,
                                const FaultPlan& plan, const TwinTime& time, std::uint64_t seed);

/// "192.168.0.7:502" or "[::1]:502" in two. Throws Failure (kUsage).
struct HostAndPort {
  std::string host;
  int port = 0;
};
HostAndPort split_address(const std::string& text);

}  // namespace plumb::offline::twin

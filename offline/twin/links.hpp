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

/// The bus of the controller, as chosen on the command line.
struct LinkChoice {
  std::string can;              // "vcan0"
  std::string modbus;           // "host:port": plumb-rt is the server, the twin the client
  std::string modbus_serve;     // "address:port": the twin is the server
  std::string rtu;              // device
  std::string role = "server";  // of the twin on the serial line
  int unit = 1;
  int baud = 115200;

  bool any() const {
    return !(can.empty() && modbus.empty() && modbus_serve.empty() && rtu.empty());
  }
  bool is_can() const { return !can.empty(); }
};

/// The layout in `file`, which is the table [bus] of an rt.toml or [deploy.bus] of a cell.toml.
/// A file without such a table has the default layout. Throws Failure (kInput).
drivers::BusLayout read_layout(const Cell& cell, const std::filesystem::path& file,
                               drivers::BusUse use);

/// An open bus and everything that its port needs.
class Link {
 public:
  virtual ~Link() = default;
  virtual drivers::BusPort& port() noexcept = 0;
  /// Tries to restore a link that is down. To be called from time to time; it may block.
  virtual void tend() noexcept {}
};

/// Opens the chosen bus. `plan` and `time` must outlive the link. Throws Failure (kEnvironment,
/// E-TWIN-BUS) with the system's reason.
std::unique_ptr<Link> open_link(const LinkChoice& choice, const drivers::BusLayout& layout,
                                const FaultPlan& plan, const TwinTime& time, std::uint64_t seed);

/// The two parts of an address such as "192.168.0.7:502" or "[::1]:502". Throws Failure (kUsage).
struct HostAndPort {
  std::string host;
  int port = 0;
};
HostAndPort split_address(const std::string& text);

}  // namespace plumb::offline::twin

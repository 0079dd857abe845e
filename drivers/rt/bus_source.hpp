// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/session.hpp"
#include "plumb/runtime/loaded_model.hpp"

namespace plumb::drivers::rt {

/// An open bus: its port and all that the port needs, such as the thread of a Modbus link.
class OpenBus {
 public:
  virtual ~OpenBus() = default;
  virtual BusPort& port() noexcept = 0;

  /// Helps a link that is down to recover. To be called from time to time by a thread that may
  /// block.
  virtual void tend() noexcept {}

  /// True if no further target will arrive.
  virtual bool finished() const noexcept { return false; }
};

/// What a bus is opened for.
struct BusTask {
  const BusLayout& layout;         // of its frames or registers
  const BusLayout& record_layout;  // in which what passes is recorded
  const LoadedModel& model;
  const SessionSettings& session;
};

/// How a bus is reached, for rules about who may.
struct BusEndpoint {
  enum class Kind : std::uint8_t { kNone, kConnects, kListens, kCan } kind = Kind::kNone;
  std::string address = {};    // of the controller, or of ours on which it is listened
  std::string interface = {};  // kCan; kListens: instead of an address
  int port = 0;
  std::vector<std::string> peers = {};  // kListens
};

/// The bus that [source] of rt.toml names. Desired targets come from it and, unless it is a file,
/// corrected targets are sent to it.
class BusSource {
 public:
  virtual ~BusSource() = default;

  /// The kind of bus for which the layout in [bus] is checked.
  virtual BusUse use() const noexcept = 0;

  /// Its name in the record: "can0", "modbus", "csv".
  virtual std::string name() const = 0;

  /// kNone: another user of this machine cannot be kept from it by the kernel's firewall.
  virtual BusEndpoint endpoint() const { return {}; }

  /// True if a robot and an operator are at the other end; false if targets come from a file.
  virtual bool has_robot() const noexcept { return true; }

  /// Opens the bus without sending anything. Throws Failure: E-RT-LINK (kEnvironment) with the
  /// system's reason, E-RT-CSV (kInput). Slow.
  virtual std::unique_ptr<OpenBus> open(const BusTask& task) const = 0;
};

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/modbus_address.hpp"
#include "plumb/drivers/modbus_exchange.hpp"

namespace plumb::drivers {

struct ModbusServerSettings {
  enum class Wildcard : std::uint8_t { kRefused, kAllowed };

  ModbusAddress at = TcpAddress{};  // host: an address of this machine or an interface ("eth1")
  Wildcard wildcard = Wildcard::kRefused;  // 0.0.0.0 and ::
  std::vector<std::string> peers = {};     // addresses that may connect; empty: this machine only
  Sender self = Sender::kPlumb;
  std::uint8_t unit = 1;  // TCP: 0 and 255 are answered too

  std::size_t most_connections = 4;
  double request_timeout_s = 0.1;  // from a request's first byte to its last
  double idle_timeout_s = 5.0;     // without a whole request
  double stale_after_s = 0.1;      // a message of ours older than this loses its check sum
  double writer_hold_s = 0.5;      // after a write, other connections may not write for so long
};

/// For controllers that poll: the layout's messages as holding registers (input registers show the
/// same). Functions 3, 4, 6, 16 and 23, nothing else.
///
/// The peer reads every register of the layout and writes those of its own messages; a message
/// counts when its last register (of the check sum) is written. Ours are put in just before they
/// are read. A message that the cycle did not renew keeps its values and counter and loses its
/// check sum; before the first one the block is zeros, which no check sum fits.
///
/// TCP is parsed here, byte for byte and fuzzed, not by libmodbus: foreign peers are refused
/// at once, connections and requests are bounded, and a connection ends when its framing breaks,
/// when a request drips, when nothing comes, or when answers are not taken. RTU is framed by
/// libmodbus; other units' requests are left alone, and so are broadcasts.
///
/// Threads: start() and stop() from one; it has its own thread between, as ModbusClient.
class ModbusServer {
 public:
  ModbusServer(const BusLayout& layout, const ModbusServerSettings& settings);
  ~ModbusServer();  // stops
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  /// Checks the settings, binds or opens, and starts. None: running.
  std::optional<LinkFault> start();

  /// Returns when the thread has ended: within a few milliseconds; RTU: a request timeout.
  void stop();

  /// The TCP port it listens on, also if 0 was asked for.
  std::uint16_t port() const noexcept;

  /// For a ModbusPort.
  ModbusExchange& exchange() noexcept;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace plumb::drivers

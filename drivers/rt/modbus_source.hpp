// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "program/toml_table.hpp"
#include "rt/bus_source.hpp"

namespace plumb::drivers::rt {

/// Modbus over TCP or a serial line, as client or as server.
class ModbusSource final : public BusSource {
 public:
  enum class Role : std::uint8_t { kClient, kServer } role = Role::kClient;  // ours
  std::string interface;              // server: a network interface to listen on
  std::string address = "127.0.0.1";  // TCP: address of the controller, or the one to listen on
  int port = 502;
  int unit = 1;
  std::vector<std::string> peers;  // TCP server: addresses that may connect, one at least
  std::string device;              // RTU; empty: TCP
  int baud = 115200;

  static std::shared_ptr<const BusSource> read(TomlTable& source,
                                               const std::filesystem::path& folder);
  BusUse use() const noexcept override { return BusUse::kModbus; }
  std::string name() const override { return "modbus"; }
  BusEndpoint endpoint() const override;
  std::unique_ptr<OpenBus> open(const BusTask& task) const override;

 private:
  /// Of a server: an address or a network interface of this machine; either key may hold either.
  const std::string& listens_at() const { return interface.empty() ? address : interface; }
};

}  // namespace plumb::drivers::rt

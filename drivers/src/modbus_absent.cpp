// SPDX-License-Identifier: Apache-2.0
// Takes the place of modbus_client.cpp and modbus_server.cpp where libmodbus is not installed.
#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_server.hpp"

namespace plumb::drivers {
namespace {

LinkFault absent() {
  return {"", "this build has no Modbus", "install libmodbus-dev and build with -DPLUMB_MODBUS=ON"};
}

}  // namespace

class ModbusClient::Work {
 public:
  ModbusExchange exchange;
};

ModbusClient::ModbusClient(const BusLayout&, const ModbusClientSettings&)
    : work_(std::make_unique<Work>()) {}
ModbusClient::~ModbusClient() = default;
std::optional<LinkFault> ModbusClient::start() { return absent(); }
void ModbusClient::stop() {}
ModbusExchange& ModbusClient::exchange() noexcept { return work_->exchange; }

struct ModbusServer::Work {
  ModbusExchange exchange;
};

ModbusServer::ModbusServer(const BusLayout&, const ModbusServerSettings&)
    : work_(std::make_unique<Work>()) {}
ModbusServer::~ModbusServer() = default;
std::optional<LinkFault> ModbusServer::start() { return absent(); }
void ModbusServer::stop() {}
std::uint16_t ModbusServer::port() const noexcept { return 0; }
ModbusExchange& ModbusServer::exchange() noexcept { return work_->exchange; }

}  // namespace plumb::drivers

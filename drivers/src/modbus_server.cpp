// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_server.hpp"

#include "link_thread.hpp"
#include "modbus_faults.hpp"
#include "modbus_serial_listener.hpp"
#include "modbus_tcp_listener.hpp"

namespace plumb::drivers {

struct ModbusServer::Work {
  Work(const BusLayout& layout, const ModbusServerSettings& asked)
      : settings(asked),
        registers(layout, asked.self, to_ns(asked.stale_after_s), exchange),
        service(registers, exchange.counters, to_ns(asked.writer_hold_s)),
        tcp(asked, service, exchange),
        serial(asked, service, exchange) {}

  std::optional<LinkFault> start();

  ModbusExchange exchange;
  ModbusServerSettings settings;
  ModbusRegisters registers;
  ModbusService service;
  ModbusTcpListener tcp;
  ModbusSerialListener serial;
  LinkThread thread;  // the last member, so that the thread ends before its data are destroyed
};

std::optional<LinkFault> ModbusServer::Work::start() {
  if (auto fault = find_fault(settings)) return fault;
  const bool on_tcp = std::holds_alternative<TcpAddress>(settings.at);
  if (on_tcp)
    if (auto fault = tcp.open()) return fault;
  const int error = thread.start("plumb-modbus", [this, on_tcp] {
    if (on_tcp) tcp.run(thread);
    if (!on_tcp) serial.run(thread);
  });
  if (error == 0) return std::nullopt;
  return cannot_run(error);
}

ModbusServer::ModbusServer(const BusLayout& layout, const ModbusServerSettings& settings)
    : work_(std::make_unique<Work>(layout, settings)) {}

ModbusServer::~ModbusServer() { stop(); }

std::optional<LinkFault> ModbusServer::start() { return work_->start(); }

void ModbusServer::stop() { work_->thread.stop(); }

std::uint16_t ModbusServer::port() const noexcept { return work_->tcp.port(); }

ModbusExchange& ModbusServer::exchange() noexcept { return work_->exchange; }

}  // namespace plumb::drivers

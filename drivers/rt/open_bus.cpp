// SPDX-License-Identifier: Apache-2.0
#include "rt/open_bus.hpp"

#include <fmt/format.h>

#include "plumb/drivers/can_interface.hpp"
#include "plumb/drivers/can_port.hpp"
#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "program/problem.hpp"
#include "rt/csv_port.hpp"

namespace plumb::drivers::rt {
namespace {

[[noreturn]] void refuse(std::string what, std::string help) {
  throw Failure(Exit::kEnvironment,
                {.code = "E-RT-LINK", .message = std::move(what), .help = std::move(help)});
}

class CanBus final : public OpenBus {
 public:
  explicit CanBus(CanPort port) : port_(std::move(port)) {}
  BusPort& port() noexcept override { return port_; }
  void tend() noexcept override { port_.recover(); }

 private:
  CanPort port_;
};

/// What the interface cannot do of what the layout asks for.
void refuse_misfit(const std::string& interface, const BusLayout& layout) {
  const auto found = read_can_interface(interface);
  if (!found) return;  // opening it says why
  for (const Finding& misfit : misfits(layout, *found))
    if (misfit.grant == Grant::kDenied)
      refuse(fmt::format("{}: {}", misfit.what, misfit.why), misfit.remedy);
}

std::unique_ptr<OpenBus> open_can(const Deployment& deployment) {
  const std::string& interface = deployment.config.source.interface;
  refuse_misfit(interface, deployment.layout);
  auto opening = CanPort::open(interface, deployment.layout, Sender::kPlumb);
  if (opening.port) return std::make_unique<CanBus>(std::move(*opening.port));
  const Finding finding = describe(opening.step);
  refuse(fmt::format("{}: {}", finding.what, finding.why), finding.remedy);
}

template <class Link>
class ModbusBus final : public OpenBus {
 public:
  ModbusBus(const BusLayout& layout, const auto& settings)
      : link_(layout, settings), port_(link_.exchange(), layout, Sender::kPlumb) {
    if (const auto fault = link_.start()) refuse(fault->what, fault->help);
  }
  BusPort& port() noexcept override { return port_; }

 private:
  Link link_;
  ModbusPort port_;
};

ModbusAddress address(const SourceConfig& source, const std::string& host) {
  if (!source.device.empty()) return SerialLine{.device = source.device, .baud = source.baud};
  return TcpAddress{.host = host, .port = static_cast<std::uint16_t>(source.port)};
}

std::unique_ptr<OpenBus> open_modbus(const Deployment& deployment) {
  const SourceConfig& source = deployment.config.source;
  const auto unit = static_cast<std::uint8_t>(source.unit);
  if (source.role == SourceConfig::Role::kClient)
    return std::make_unique<ModbusBus<ModbusClient>>(
        deployment.layout,
        ModbusClientSettings{.server = address(source, source.address), .unit = unit});
  const std::string& host = source.interface.empty() ? source.address : source.interface;
  return std::make_unique<ModbusBus<ModbusServer>>(
      deployment.layout,
      ModbusServerSettings{.at = address(source, host), .peers = source.peers, .unit = unit});
}

class CsvBus final : public OpenBus {
 public:
  explicit CsvBus(const Deployment& deployment)
      : port_(read_csv_targets(deployment.config.source.file, joints(deployment)),
              deployment.model.loaded->corrector().nominal(), deployment.session.robot,
              record_layout(deployment), lead(deployment)) {}
  BusPort& port() noexcept override { return port_; }
  bool finished() const noexcept override { return port_.finished(); }

 private:
  static int joints(const Deployment& deployment) {
    return deployment.model.loaded->corrector().nominal().joints();
  }
  /// Until the session has compared, waited for its inputs and ramped in.
  static int lead(const Deployment& deployment) {
    const SessionSettings& session = deployment.session;
    const double s = session.rearm_s + 2.0 * deployment.model.loaded->limits().ramp_s;
    return session.sync.poses + 10 + static_cast<int>(s / session.cycle_s);
  }

  CsvPort port_;
};

}  // namespace

std::unique_ptr<OpenBus> open_bus(const Deployment& deployment) {
  switch (deployment.config.source.kind) {
    case SourceConfig::Kind::kCan:
      return open_can(deployment);
    case SourceConfig::Kind::kModbus:
      return open_modbus(deployment);
    case SourceConfig::Kind::kCsv:
      break;
  }
  return std::make_unique<CsvBus>(deployment);
}

std::string bus_name(const SourceConfig& source) {
  if (source.kind == SourceConfig::Kind::kCan) return source.interface;
  return source.kind == SourceConfig::Kind::kModbus ? "modbus" : "csv";
}

BusLayout record_layout(const Deployment& deployment) {
  BusLayout out = deployment.layout;
  if (deployment.config.source.kind != SourceConfig::Kind::kCan)
    out.can_format = CanFrame::Format::kFd;
  return out;
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "twin/links.hpp"

#include <fmt/format.h>

#include <charconv>

#include "bus_text/bus_arm.hpp"
#include "bus_text/layout_toml.hpp"
#include "plumb/drivers/can_port.hpp"
#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "program/file.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline::twin {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& help) {
  throw Failure(Exit::kEnvironment, {.code = "E-TWIN-BUS", .message = what, .help = help});
}

class LinkWire final : public CanWire {
 public:
  explicit LinkWire(drivers::CanLink link) : link_(std::move(link)) {}
  bool write(const drivers::CanFrame& frame) noexcept override { return link_.send(frame); }
  bool read(drivers::CanFrame& frame) noexcept override { return link_.receive(frame); }
  drivers::LinkState state() const noexcept override { return link_.state(); }
  void tend() const noexcept {
    if (link_.state() == drivers::LinkState::kDown) (void)link_.recover();
  }

 private:
  drivers::CanLink link_;
};

class CanBus final : public Link {
 public:
  CanBus(drivers::CanLink link, const drivers::BusLayout& layout, const FaultPlan& plan,
         const TwinTime& time, std::uint64_t seed)
      : wire_(std::move(link)), port_(wire_, layout, plan, time, seed) {}
  drivers::BusPort& port() noexcept override { return port_; }
  void tend() noexcept override { wire_.tend(); }

 private:
  LinkWire wire_;
  FaultyCanPort port_;
};

std::unique_ptr<Link> open_can(const std::string& interface, const drivers::BusLayout& layout,
                               const FaultPlan& plan, const TwinTime& time, std::uint64_t seed) {
  const auto filters = drivers::can_filters(layout);
  auto opening = drivers::CanLink::open(interface, filters, drivers::can_link_options(layout));
  if (opening.link)
    return std::make_unique<CanBus>(std::move(*opening.link), layout, plan, time, seed);
  const drivers::Finding finding = drivers::describe(opening.step);
  refuse(fmt::format("{}: {}", finding.what, finding.why), finding.remedy);
}

template <class Peer>
class ModbusBus final : public Link {
 public:
  template <class Settings>
  ModbusBus(const drivers::BusLayout& layout, const Settings& settings, const FaultPlan& plan,
            const TwinTime& time, std::uint64_t seed)
      : peer_(layout, settings),
        inner_(peer_.exchange(), layout, drivers::Sender::kController),
        port_(inner_, plan, time, seed) {
    if (const auto fault = peer_.start()) refuse(fault->what, fault->help);
  }
  drivers::BusPort& port() noexcept override { return port_; }

 private:
  Peer peer_;
  drivers::ModbusPort inner_;
  FaultyPort port_;
};

drivers::ModbusAddress address(const LinkChoice& choice) {
  if (!choice.rtu.empty()) return drivers::SerialLine{.device = choice.rtu, .baud = choice.baud};
  const auto at = split_address(choice.modbus.empty() ? choice.modbus_serve : choice.modbus);
  return drivers::TcpAddress{.host = at.host, .port = static_cast<std::uint16_t>(at.port)};
}

}  // namespace

HostAndPort split_address(const std::string& text) {
  const auto colon = text.rfind(':');
  HostAndPort out{text.substr(0, colon), 0};
  const std::string port = colon == std::string::npos ? "" : text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), out.port);
  if (error != std::errc() || end != port.data() + port.size() || out.port < 0 ||
      out.port > 65535 || out.host.empty())
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = fmt::format("'{}' is no address and port", text),
                                 .help = "for example 127.0.0.1:1502"});
  if (out.host.starts_with('[') && out.host.ends_with(']'))
    out.host = out.host.substr(1, out.host.size() - 2);
  return out;
}

drivers::BusLayout read_layout(const Cell& cell, const std::filesystem::path& file,
                               drivers::BusUse use) {
  const auto arm = drivers::bus_arm(cell.nominal, cell.deploy.cycle_s);
  TomlSource source(display_name(file), read_file(file), "E-TWIN");
  const toml::table root = source.parse();
  const toml::node_view<const toml::node> at =
      root.contains("bus") ? root["bus"] : root["deploy"]["bus"];
  const toml::table empty;
  const toml::table* found = at.as_table();
  TomlTable bus(found != nullptr ? *found : empty, root.contains("bus") ? "bus" : "deploy.bus",
                source);
  const auto owner =
      root.contains("bus") ? drivers::MissingOwner::kNone : drivers::MissingOwner::kDefault;
  auto layout = drivers::read_bus(bus, arm, use, owner);
  source.stop_on_errors();
  return layout;
}

std::unique_ptr<Link> open_link(const LinkChoice& choice, const drivers::BusLayout& layout,
                                const FaultPlan& plan, const TwinTime& time, std::uint64_t seed) {
  if (choice.is_can()) return open_can(choice.can, layout, plan, time, seed);
  const bool serves =
      !choice.modbus_serve.empty() || (!choice.rtu.empty() && choice.role == "server");
  const auto unit = static_cast<std::uint8_t>(choice.unit);
  if (serves) {
    drivers::ModbusServerSettings settings;
    settings.at = address(choice);
    settings.peers = {"127.0.0.1", "::1"};
    settings.self = drivers::Sender::kController;
    settings.unit = unit;
    return std::make_unique<ModbusBus<drivers::ModbusServer>>(layout, settings, plan, time, seed);
  }
  drivers::ModbusClientSettings settings;
  settings.server = address(choice);
  settings.self = drivers::Sender::kController;
  settings.unit = unit;
  return std::make_unique<ModbusBus<drivers::ModbusClient>>(layout, settings, plan, time, seed);
}

}  // namespace plumb::offline::twin

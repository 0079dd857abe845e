// SPDX-License-Identifier: Apache-2.0
#include "rt/modbus_source.hpp"

#include "plumb/drivers/modbus_address.hpp"
#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "rt/link_refusal.hpp"
#include "rt/whole_number.hpp"

namespace plumb::drivers::rt {
namespace {

template <class Link>
class ModbusBus final : public OpenBus {
 public:
  ModbusBus(const BusLayout& layout, const auto& settings)
      : link_(layout, settings), port_(link_.exchange(), layout, Sender::kPlumb) {
    if (const auto fault = link_.start()) refuse_link(fault->what, fault->help);
  }
  BusPort& port() noexcept override { return port_; }

 private:
  Link link_;
  ModbusPort port_;
};

ModbusAddress address_of(const ModbusSource& source, const std::string& host) {
  if (!source.device.empty()) return SerialLine{.device = source.device, .baud = source.baud};
  return TcpAddress{.host = host, .port = static_cast<std::uint16_t>(source.port)};
}

}  // namespace

std::shared_ptr<const BusSource> ModbusSource::read(TomlTable& source,
                                                    const std::filesystem::path&) {
  auto out = std::make_shared<ModbusSource>();
  out->role =
      source.choice("role", {"client", "server"}) == "client" ? Role::kClient : Role::kServer;
  out->address = source.text_or("address", out->address);
  read_whole(source, "port", {1, 65535}, out->port);
  read_whole(source, "unit", {0, 255}, out->unit);
  for (const auto& peer : source.texts("peers")) out->peers.push_back(peer.text);
  out->device = source.text_or("device", "");
  read_whole(source, "baud", {300, 4'000'000}, out->baud);
  out->interface = source.text_or("interface", "");
  if (out->role == Role::kServer && out->device.empty() && out->peers.empty())
    source.error(source.source().code("PEERS"),
                 "as Modbus server, plumb-rt admits nobody whom 'peers' does not name",
                 *source.node("role"), "needs 'peers' beside it",
                 "peers = [\"192.168.0.10\"], the address of the controller; then: plumb-rt seal "
                 "FOLDER");
  return out;
}

BusEndpoint ModbusSource::endpoint() const {
  using Kind = BusEndpoint::Kind;
  if (!device.empty()) return {};
  if (role == Role::kClient) return {.kind = Kind::kConnects, .address = address, .port = port};
  const bool numeric = socket_address(listens_at(), 0).has_value();
  return {.kind = Kind::kListens,
          .address = numeric ? listens_at() : "",
          .interface = numeric ? "" : listens_at(),
          .port = port,
          .peers = peers};
}

std::unique_ptr<OpenBus> ModbusSource::open(const BusTask& task) const {
  const auto own_unit = static_cast<std::uint8_t>(unit);
  if (role == Role::kClient)
    return std::make_unique<ModbusBus<ModbusClient>>(
        task.layout, ModbusClientSettings{.server = address_of(*this, address), .unit = own_unit});
  return std::make_unique<ModbusBus<ModbusServer>>(
      task.layout, ModbusServerSettings{
                       .at = address_of(*this, listens_at()), .peers = peers, .unit = own_unit});
}

}  // namespace plumb::drivers::rt

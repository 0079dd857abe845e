// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "bus_text/layout_toml.hpp"
#include "bus_text/reach.hpp"
#include "cell/cell_sections.hpp"
#include "cell/host_and_port.hpp"

namespace plumb::offline {
namespace {

void read_limits(TomlTable& t, DeploySettings& deploy) {
  if (const auto cycle = t.number("cycle_us")) {
    deploy.cycle_s = unit_of("us")->to_si(*cycle);
    if (*cycle < 100.0 || *cycle > 1e6) t.out_of_range("cycle_us", "between 100 and 1000000");
  }
  if (const auto most = t.number("max_correction_mm")) {
    deploy.max_correction_m = unit_of("mm")->to_si(*most);
    if (*most <= 0.0 || *most > 50.0)
      t.out_of_range("max_correction_mm", "greater than 0, at most 50");
  }
}

/// No port, or one that a controller can listen on.
bool is_port_or_none(const std::string& port, const std::string& address) {
  if (port.empty()) return !address.ends_with(':');
  int number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  return error == std::errc() && end == port.data() + port.size() && number >= 1 && number <= 65535;
}

void read_link(TomlTable& t, DeploySettings& deploy) {
  if (t.choice("link", {"can", "modbus"}) == "modbus") deploy.link = drivers::BusUse::kModbus;
  deploy.interface = t.text_or("interface", deploy.interface);
  if (deploy.interface.empty() || deploy.interface.size() > 15)
    t.out_of_range("interface", "the name of a CAN interface, 1 to 15 characters");
  deploy.address = t.text_or("address", deploy.address);
  const auto [host, port] = host_and_port(deploy.address);
  if (host.empty() || !is_port_or_none(port, deploy.address))
    t.out_of_range("address", "a host, or a host and a port from 1 to 65535: \"10.0.0.7:1502\"");
}

/// Only if the file has one: a cell that is not to be deployed need not think of a bus.
void read_bus_table(TomlTable& t, Cell& cell) {
  auto bus = t.table("bus");
  if (!bus || cell.nominal.joints.empty()) return;
  const std::size_t before = t.source().problems().errors().size();
  cell.deploy.bus = std::make_shared<const drivers::BusLayout>(drivers::read_bus(
      *bus, drivers::bus_arm(cell.nominal, cell.deploy.cycle_s), cell.deploy.link));
  if (cell.deploy.link != drivers::BusUse::kCan || t.source().problems().errors().size() != before)
    return;
  for (const auto& fault : drivers::find_short_reach(*cell.deploy.bus, cell.nominal,
                                                     cell.deploy.max_correction_m, "deploy.bus"))
    drivers::report_fault(*bus, fault);
}

}  // namespace

void read_deploy(TomlTable& t, CellDraft& draft) {
  read_limits(t, draft.cell.deploy);
  read_link(t, draft.cell.deploy);
  read_bus_table(t, draft.cell);
  t.done();
}

}  // namespace plumb::offline

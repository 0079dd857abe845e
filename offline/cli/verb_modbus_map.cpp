// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "bus_text/modbus_map.hpp"
#include "cli/bus_output.hpp"
#include "cli/cell_data.hpp"
#include "cli/verbs.hpp"
#include "deploy/bus_of_cell.hpp"

namespace plumb::offline::cli {
namespace {

struct ModbusMapArguments {
  BusOutput output;
  bool csv = false;
};

void run_map(const ModbusMapArguments& options, const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome);
  const drivers::BusLayout layout = bus_of(cell, drivers::BusUse::kModbus);
  const std::size_t registers = drivers::modbus_registers(layout);
  outcome.result = {{"messages", layout.messages.size()}, {"registers", registers}};
  put_out(options.output, options.csv ? "csv" : "markdown",
          options.csv ? drivers::modbus_map_csv(layout)
                      : drivers::modbus_map_markdown(layout, about(cell)),
          fmt::format("The registers of {}: {} messages in {} registers.", cell.name,
                      layout.messages.size(), registers),
          outcome);
}

}  // namespace

void add_modbus_map(Program& program) {
  const auto options = std::make_shared<ModbusMapArguments>();
  VerbOptions verb = program.verb(
      {.name = "modbus-map",
       .summary = "The Modbus registers as Markdown or CSV",
       .examples = "  plumb modbus-map -o modbus-map.md\n  plumb -C mycell modbus-map --csv"},
      [options](const Globals& g, Outcome& o) { run_map(*options, g, o); });
  verb.add_flag("--csv", options->csv, "As CSV instead of Markdown");
  options->output.add_to(verb);
}

}  // namespace plumb::offline::cli

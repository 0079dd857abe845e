// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "bus_text/dbc.hpp"
#include "cli/bus_output.hpp"
#include "cli/cell_data.hpp"
#include "cli/verbs.hpp"
#include "deploy/bus_of_cell.hpp"

namespace plumb::offline::cli {
namespace {

void run_dbc(const BusOutput& output, const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome);
  const drivers::BusLayout layout = bus_of(cell, drivers::BusUse::kCan);
  std::size_t frames = 0;
  for (const auto& message : layout.messages) frames += drivers::can_frames(layout, message);
  const double load_pct = 100.0 * drivers::worst_bus_load(layout);
  outcome.result = {{"messages", layout.messages.size()}, {"frames", frames}};
  put(outcome.result, "worst_bus_load_pct", load_pct);
  put_out(output, "dbc", drivers::write_dbc(layout, about(cell)),
          fmt::format("The bus of {}: {} messages in {} frames, at worst {:.0f} % of the bus.",
                      cell.name, layout.messages.size(), frames, std::ceil(load_pct)),
          outcome);
}

}  // namespace

void add_dbc(Program& program) {
  const auto output = std::make_shared<BusOutput>();
  VerbOptions verb =
      program.verb({.name = "dbc",
                    .summary = "The CAN layout as a DBC file, for controllers and bus tools",
                    .examples = "  plumb dbc -o bus.dbc\n  plumb -C mycell dbc | less"},
                   [output](const Globals& g, Outcome& o) { run_dbc(*output, g, o); });
  output->add_to(verb);
}

}  // namespace plumb::offline::cli

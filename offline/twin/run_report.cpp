// SPDX-License-Identifier: Apache-2.0
#include "twin/run_report.hpp"

#include <fmt/format.h>

#include "plumb/drivers/session_transition.hpp"

namespace plumb::offline::twin {
namespace {

bool was_heard(const Controller& controller) {
  return controller.session_age_s() < std::numeric_limits<double>::infinity();
}

std::string state_of(const Controller& controller) {
  return was_heard(controller) ? drivers::to_string(controller.session().state) : "silent";
}

Json port_json(const drivers::PortCounters& port) {
  return {{"received", port.received}, {"sent", port.sent},
          {"corrupt", port.corrupt},   {"repeated", port.repeated},
          {"skipped", port.skipped},   {"overflowed", port.overflowed},
          {"not_sent", port.not_sent}, {"reconnects", port.reconnects},
          {"restarts", port.restarts}, {"foreign_senders", port.foreign_senders}};
}

Json receiver_json(const Receiver::Counters& heard) {
  return {{"used", heard.used},
          {"stale", heard.stale},
          {"overtaken", heard.overtaken},
          {"oldest_ms", heard.oldest_s * 1e3},
          {"too_large", heard.too_large}};
}

Json states_json(const std::vector<StateSeen>& states) {
  Json out = Json::array();
  for (const StateSeen& seen : states) {
    Json one{{"state", drivers::to_string(seen.state)}};
    if (seen.path_s >= 0.0)
      put(one, "path_s", seen.path_s);
    else
      put_null(one, "path_s", "before the path began");
    out.push_back(one);
  }
  return out;
}

void complain(const Controller& controller, Outcome& outcome) {
  outcome.exit = Exit::kBusLost;
  if (!was_heard(controller)) {
    outcome.errors.push_back({.code = "E-TWIN-SILENT",
                              .message = "nothing was heard of plumb-rt on this bus",
                              .help = "start it beside this: plumb-rt run DIR"});
    return;
  }
  outcome.errors.push_back(
      {.code = "E-TWIN-INACTIVE",
       .message = fmt::format("plumb-rt sent no correction in time: it is in state '{}'",
                              state_of(controller)),
       .help = "plumb-rt status; for corrections rt.toml says [limits] mode = \"full\""});
}

}  // namespace

void add_stops(const std::vector<Stop>& stops, const TrueErrors& errors, Outcome& outcome) {
  Json out = Json::array();
  for (std::size_t k = 0; k < stops.size(); ++k)
    out.push_back({{"station", stops[k].station},
                   {"path_s", stops[k].path_s},
                   {"settled", stops[k].settled},
                   {"correction_mm", stops[k].offset.translation.norm() * 1e3},
                   {"true_mm", errors.each_m[k] * 1e3}});
  outcome.result["stops"] = out;
}

void add_loop(const Controller& controller, const drivers::PortCounters& port, std::uint64_t missed,
              Outcome& outcome) {
  const ControllerCounters& counted = controller.counters();
  const auto& heard = controller.receiver().counters();
  Json loop{{"cycles", counted.cycles},
            {"missed", missed},
            {"state", state_of(controller)},
            {"states", states_json(controller.states())},
            {"corrections", receiver_json(heard)},
            {"no_inverse", counted.no_inverse},
            {"largest_step_um", counted.largest_step_m * 1e6},
            {"largest_correction_mm", counted.largest_offset_m * 1e3},
            {"port", port_json(port)}};
  if (was_heard(controller))
    loop["status"] = to_string(controller.session().status);
  else
    put_null(loop, "status", "plumb-rt was never heard");
  if (counted.first_active_s >= 0.0)
    put(loop, "first_active_s", counted.first_active_s);
  else
    put_null(loop, "first_active_s", "plumb-rt was never active");
  outcome.result["loop"] = loop;
  outcome.text += fmt::format(
      "\n  {} cycles, {} missed; {} corrections used, {} too old, {} overtaken, {} too large\n"
      "  largest correction {:.3f} mm, its largest step {:.1f} um a cycle; plumb-rt: {}\n",
      counted.cycles, missed, heard.used, heard.stale, heard.overtaken, heard.too_large,
      counted.largest_offset_m * 1e3, counted.largest_step_m * 1e6, state_of(controller));
  if (controller.gave_up()) complain(controller, outcome);
}

}  // namespace plumb::offline::twin

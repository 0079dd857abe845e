// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "program/file.hpp"
#include "twin/drive.hpp"
#include "twin/run_report.hpp"
#include "twin/stop_log.hpp"
#include "twin/tracker.hpp"
#include "twin/verbs.hpp"

namespace plumb::offline::twin {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = M_PI / 180.0;

struct RunArguments {
  std::string directory, path, layout;
  LinkChoice link;
  std::string correction = "both";
  std::vector<std::string> faults;
  bool list_faults = false;
  int stations = 500;
  double range_pct = 50.0;
  double fastest_deg_s = 120.0, fastest_mm_s = 1500.0, dwell_s = 0.15, wait_s = 30.0,
         duration_s = 0.0;
  bool gate = false;
  std::string stops;  // file to write each stop to; empty: none
  bool force = false;
};

void list(Outcome& outcome) {
  outcome.result = {{"faults", Json::array()}};
  outcome.text =
      "Faults that --fault takes, as NAME[=SIZE][@START[+SECONDS]]; START: since the path "
      "began\n\n";
  for (const auto& [name, line] : known_faults()) {
    outcome.result["faults"].push_back({{"fault", name}, {"about", line}});
    outcome.text += fmt::format("  {:<14} {}\n", name, line);
  }
}

ControllerSettings settings_of(const RunArguments& options, const Cell& cell) {
  return {.cycle_s = cell.deploy.cycle_s,
          .fastest = {.joint_rad_per_s = options.fastest_deg_s * kDegree,
                      .tool_m_per_s = options.fastest_mm_s * 1e-3},
          .dwell_s = options.dwell_s,
          .wait_s = options.wait_s};
}

FaultPlan faults_of(const RunArguments& options) {
  std::vector<Fault> out;
  for (const auto& text : options.faults) out.push_back(parse_fault(text));
  return FaultPlan(std::move(out));
}

/// A twin that is ready to run: its folder, its hidden truth and its path.
struct Twin : TwinFolder {
  HiddenTruth truth;
  Path path;
};

Twin open(const RunArguments& options, Outcome& outcome) {
  Twin out{open_folder(options.directory, outcome), {}, {}};
  out.truth = truth_of(out.cell, out.hidden);
  out.path = options.path.empty() ? generated_path(out.cell, options.stations,
                                                   options.range_pct * 0.01, out.hidden.seed)
                                  : path_from(out.cell, options.path);
  return out;
}

/// Drives the path in real time with corrections from plumb-rt.
std::vector<Stop> drive_corrected(const RunArguments& options, const Twin& twin,
                                  const std::vector<double>& off_m, Outcome& outcome) {
  const fs::path layout_file =
      options.layout.empty() ? fs::path(options.directory) / "cell.toml" : fs::path(options.layout);
  const auto use = options.link.is_can() ? drivers::BusUse::kCan : drivers::BusUse::kModbus;
  const auto layout = read_layout(twin.cell, layout_file, use);
  const FaultPlan faults = faults_of(options);
  const auto settings = settings_of(options, twin.cell);
  TwinTime time;
  const auto link = open_link(options.link, layout, faults, time, twin.hidden.seed);
  Controller controller(twin.cell, twin.path, settings, Controller::Corrections::kUse, layout,
                        faults, time);
  controller.knows(true_chain(twin.cell, twin.truth));
  controller.feels(readings_along(twin.cell, twin.hidden, twin.truth, twin.path));
  std::optional<StopLog> log;
  if (!options.stops.empty())
    log.emplace(options.stops, StopLog::Arm{.cell = twin.cell,
                                            .hidden = twin.hidden,
                                            .truth = twin.truth,
                                            .stations = twin.path.stations(),
                                            .off_m = off_m});
  const auto missed =
      drive_in_real_time(controller, *link, settings.cycle_s, options.duration_s, [&] {
        if (log) log->look(controller.stops());
        return false;
      });
  if (log) {
    log->look(controller.stops());
    log->finish();
  }
  add_loop(controller, link->port().counters(), missed, outcome);
  return controller.stops();
}

int unsettled(const std::vector<Stop>& stops) {
  int out = 0;
  for (const Stop& stop : stops) out += stop.settled ? 0 : 1;
  return out;
}

void check(const RunArguments& options) {
  if (options.correction == "off" || options.link.any()) return;
  if (options.correction == "both") return;
  throw Failure(Exit::kUsage, {.code = "E-USAGE",
                               .message = "corrections come over a bus, and none is named",
                               .help = "for example: plumb-twin run mytwin --can vcan0"});
}

void refuse_existing(const RunArguments& options) {
  if (options.stops.empty() || options.force || !would_replace(options.stops)) return;
  throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                               .message = options.stops + " is already there",
                               .help = "to replace it, add --force"});
}

void run(const RunArguments& options, Outcome& outcome) {
  if (options.list_faults) return list(outcome);
  check(options);
  refuse_existing(options);
  (void)faults_of(options);
  const Twin twin = open(options, outcome);
  Comparison found;
  found.floor = floor_of(twin.hidden.noise_m);
  const auto errors = [&](const std::vector<Stop>& stops) {
    return true_errors(twin.cell, twin.hidden, twin.truth, twin.path.stations(), stops);
  };
  outcome.result = Json::object();
  if (options.correction != "on")
    found.off = errors(drive_uncorrected(twin.cell, twin.path, settings_of(options, twin.cell)));
  if (options.correction != "off" && options.link.any()) {
    const auto stops = drive_corrected(options, twin, found.off.each_m, outcome);
    found.unsettled = unsettled(stops);
    found.on = errors(stops);
    add_stops(stops, found.on, outcome);
  }
  outcome.result.update(to_json(found));
  outcome.verdicts = {verdict(found)};
  outcome.text = to_text(found) + outcome.text;
  if (!options.gate || found.reached() || !outcome.errors.empty()) return;
  outcome.exit = Exit::kGateFailed;
  outcome.errors.push_back({.code = "E-GATE",
                            .message = "--gate: the error did not fall as it should",
                            .help = "plumb-rt monitor"});
}

void add_options(RunArguments& o, VerbOptions& verb) {
  verb.add_option("DIR", o.directory, "Folder of the twin");
  verb.add_option("--can", o.link.can, "CAN interface").type_name("NAME");
  verb.add_option("--modbus", o.link.modbus, "plumb-rt is the Modbus server there")
      .type_name("HOST:PORT");
  verb.add_option("--modbus-serve", o.link.modbus_serve, "We are the Modbus server there")
      .type_name("ADDR:PORT");
  verb.add_option("--rtu", o.link.rtu, "Modbus RTU on a serial device").type_name("DEVICE");
  verb.add_option("--role", o.link.role, "Ours on the serial line")
      .check(one_of({"server", "client"}))
      .shows_default();
  verb.add_option("--unit", o.link.unit, "Modbus unit").check(whole_number_between(0, 255));
  verb.add_option("--baud", o.link.baud, "Of the serial line")
      .check(whole_number_between(300, 4000000));
  verb.add_option("--layout", o.layout,
                  "rt.toml or cell.toml with the bus layout; else the cell.toml of DIR")
      .type_name("FILE");
  verb.add_option("--correction", o.correction, "Drive the path without, with, or both")
      .check(one_of({"on", "off", "both"}))
      .shows_default();
  verb.add_option("--path", o.path, "Stations: targets as for plumb correct; else made up")
      .type_name("FILE");
  verb.add_option("--stations", o.stations, "How many stations of a made-up path")
      .check(whole_number_between(2, 10000))
      .shows_default();
  verb.add_option("--range", o.range_pct, "Share of each joint's range that it uses, percent")
      .check(number_between(1.0, 100.0))
      .shows_default();
  verb.add_option("--speed-deg-s", o.fastest_deg_s, "Fastest speed of a joint")
      .check(number_between(0.1, 1000.0))
      .shows_default();
  verb.add_option("--speed-mm-s", o.fastest_mm_s, "Fastest speed of the tool")
      .check(number_between(0.1, 1e5))
      .shows_default();
  verb.add_option("--dwell-s", o.dwell_s, "At every station, at least")
      .check(number_between(0.0, 100.0))
      .shows_default();
  verb.add_option("--wait-s", o.wait_s,
                  "How long to wait for corrections before the path begins; 0: begin at once")
      .check(number_between(0.0, 1e6))
      .shows_default();
  verb.add_option("--duration-s", o.duration_s, "End after so long, wherever the arm is; 0: never")
      .check(number_between(0.0, 1e9))
      .shows_default();
  verb.add_option("--stops", o.stops,
                  "Write every stop with its true error to this CSV file as it is driven")
      .type_name("FILE");
  verb.add_flag("--force", o.force, "Replace that file if it is already there");
  verb.add_option("--fault", o.faults,
                  "What is wrong, and when; may be repeated; see --list-faults")
      .type_name("FAULT");
  verb.add_flag("--list-faults", o.list_faults, "List the faults that --fault takes");
  verb.add_flag("--gate", o.gate,
                "Exit 1 unless the error falls five times and below 1.3 times the tracker's noise");
}

}  // namespace

void add_run(Program& program) {
  const auto options = std::make_shared<RunArguments>();
  VerbOptions verb = program.verb(
      {.name = "run",
       .summary =
           "Drive a path, take corrections from the bus, and say how far the true arm missed",
       .examples = "  plumb-twin run mytwin --can vcan0\n"
                   "  plumb-twin run mytwin --modbus-serve 127.0.0.1:1502 --fault lose=30%@5+10"},
      [options](const Globals&, Outcome& o) { run(*options, o); });
  add_options(*options, verb);
}

}  // namespace plumb::offline::twin

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "cell/setups.hpp"
#include "cli/cell_data.hpp"
#include "cli/effect_argument.hpp"
#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "plan/planning.hpp"
#include "program/output_files.hpp"
#include "program/shell_word.hpp"
#include "recheck/recheck_plan.hpp"
#include "runs/run_store.hpp"
#include "show/plan_view.hpp"
#include "show/recheck_view.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kUsualPoses = 30, kRecheckPoses = 12;

struct PlanArguments {
  int n = 0, pool = 5000;  // n = 0: the usual number
  std::uint64_t seed = 1;
  std::string limits, separate, payloads, output = "plan.csv";
  std::vector<std::string> boxes;
  bool recheck = false;
  WriteOptions write;
};

[[noreturn]] void usage(const std::string& message, const std::string& help) {
  throw Failure(Exit::kUsage, {.code = "E-USAGE", .message = message, .help = help});
}

PoseRules::Box box_of(const std::string& text) {
  std::array<double, 6> mm{};
  const char* at = text.data();
  const char* const end = at + text.size();
  bool good = true;
  for (std::size_t k = 0; k < 6 && good; ++k) {
    const auto [stop, error] = std::from_chars(at, end, mm[k]);
    good = error == std::errc{} && (k == 5 ? stop == end : stop != end && *stop == ',');
    at = stop + 1;
  }
  for (std::size_t k = 0; k < 3; ++k)
    good = good && std::isfinite(mm[2 * k]) && mm[2 * k] < mm[2 * k + 1] &&
           std::isfinite(mm[2 * k + 1]);
  if (!good)
    usage(fmt::format("'{}' is no box", text),
          "--box xmin,xmax,ymin,ymax,zmin,zmax in mm: --box -1000,1000,-1000,1000,0,1500");
  PoseRules::Box out;
  for (std::size_t k = 0; k < 3; ++k)
    out.low[k] = mm[2 * k] * 1e-3, out.high[k] = mm[2 * k + 1] * 1e-3;
  return out;
}

double share_of(const std::string& text) {
  if (text.empty()) return 1.0;
  double share = parse_percent(text).value_or(-1.0);
  const char* end = text.data() + text.size();
  double number = 0.0;
  if (share < 0.0 && std::from_chars(text.data(), end, number).ptr == end) share = number;
  if (!(share > 0.0 && share <= 1.0))
    usage(fmt::format("'{}' is no share of the joint limits", text), "--joint-limits 90%");
  return share;
}

/// Loads that can be mounted [kg].
std::vector<double> loads_of(const std::string& text) {
  std::vector<double> out;
  const char* at = text.data();
  const char* const end = at + text.size();
  bool good = true;
  while (good && at != end) {
    double kg = 0.0;
    const auto [stop, error] = std::from_chars(at, end, kg);
    good = error == std::errc{} && std::isfinite(kg) && kg >= 0.0 &&
           (stop == end || (*stop == ',' && stop + 1 != end)) &&
           std::find(out.begin(), out.end(), kg) == out.end();
    out.push_back(kg);
    at = stop == end ? end : stop + 1;
  }
  if (!good || out.size() < 2)
    usage(fmt::format("'{}' is no list of two or more different loads", text),
          "masses in kg that can be mounted, 0 for none: --payload 0,10");
  std::sort(out.begin(), out.end());
  return out;
}

PlanRequest request_of(const PlanArguments& options, const Cell& cell) {
  PlanRequest out;
  out.n = options.n > 0 ? options.n : kUsualPoses;
  out.rules.pool = std::max(options.pool, out.n);
  out.rules.seed = options.seed;
  out.rules.joint_share = share_of(options.limits);
  for (const auto& box : options.boxes) out.rules.boxes.push_back(box_of(box));
  if (!options.separate.empty()) out.separate = two_effects(cell, options.separate);
  if (!options.payloads.empty()) {
    if (options.separate.empty())
      usage("--payload is of use only with --separate", "plumb plan --separate A,B --payload 0,10");
    out.payloads_kg = loads_of(options.payloads);
  }
  return out;
}

bool measured_already(const Cell& cell) {
  MeasurementSettings settings = cell.measurement;
  settings.held_out = {};
  for (const auto& file : measurement_files(settings))
    if (fs::exists(file)) return true;
  return false;
}

/// A file beside the cell that does not exist yet: the measurements made so far are kept.
fs::path new_measurements(const Cell& cell) {
  for (int day = 2;; ++day)
    if (fs::path file = cell.directory / fmt::format("measurements_{}.csv", day); !fs::exists(file))
      return file;
}

/// The table of poses; its name alone before there is one.
OutputFiles planned_file(const PlanArguments& options, std::string table = "") {
  OutputFiles out;
  out.add(options.output, std::move(table));
  return out;
}

/// Poses of the calibration that tell best what has changed since.
void plan_the_recheck(const PlanArguments& options, const Globals& globals, Outcome& outcome) {
  if (!options.separate.empty() || !options.boxes.empty() || !options.limits.empty())
    usage("--recheck chooses among the poses of the calibration",
          "leave out --separate, --box and --joint-limits: plumb plan --recheck --n 12");
  Cell cell = open_cell(globals, outcome);
  planned_file(options).check(options.write, outcome);
  const MeasurementFiles measured = open_measurements(cell, outcome);
  check_plannable(cell);
  const Run run = latest_recheck(cell, current_or_new_run(cell, measured, Keep::kRun, outcome));
  const Run calibrated = calibrated_run(cell, run);
  const int n = options.n > 0 ? options.n : kRecheckPoses;
  const recheck::RecheckPlan found = recheck::plan_recheck(cell, calibrated, run, measured, n);
  outcome.result = show::recheck_plan_json(cell, found, run, measured);
  planned_file(options, show::recheck_plan_csv(cell, found, measured))
      .commit(options.write, outcome);
  put(show::recheck_plan_blocks(cell, found, run), outcome);
  outcome.text +=
      "\n" + wrote(options.output, options.write) +
      "\nMeasure these poses, then join what the tracker wrote with their joint angles.\n";
  say_next(
      globals,
      {fmt::format("import tracker.txt {} --join order -o recheck.csv", shell_word(options.output)),
       "recheck --data recheck.csv"},
      outcome);
}

void plan(const PlanArguments& options, const Globals& globals, Outcome& outcome) {
  if (options.recheck) return plan_the_recheck(options, globals, outcome);
  Cell cell = open_cell(globals, outcome);
  const PlanRequest request = request_of(options, cell);
  planned_file(options).check(options.write, outcome);
  const MeasurementFiles measured = measured_already(cell)
                                        ? open_measurements(cell, outcome)
                                        : MeasurementFiles{nothing_measured(cell), {}};
  const Progress progress(fmt::format("choosing among {} poses", request.rules.pool));
  const PosePlan found = plan_poses(cell, measured, request);
  outcome.remark(found.remarks);
  outcome.result = show::plan_json(cell, request, found);
  planned_file(options, show::plan_csv(cell, request, found)).commit(options.write, outcome);
  put(show::plan_blocks(request, found), outcome);
  outcome.text += "\n" + wrote(options.output, options.write) +
                  "\nMeasure these poses in this order. Then join what the tracker wrote with the "
                  "joint angles of this plan, and name the new file in cell.toml.\n";
  say_next(globals,
           fmt::format("import tracker.txt {} --join order -o {}", shell_word(options.output),
                       shell_word(new_measurements(cell).string())),
           outcome);
}

}  // namespace

void add_plan(Program& program) {
  const auto options = std::make_shared<PlanArguments>();
  VerbOptions verb = program.verb(
      {.name = "plan",
       .summary = "The next poses to measure: for the arm, or to tell two effects apart",
       .examples = "  plumb plan --n 30 -o plan.csv     # what these poses leave uncertain\n"
                   "  plumb plan --separate reversal:J2,settling_lag:J2 --n 40"},
      [options](const Globals& g, Outcome& o) { plan(*options, g, o); });
  verb.add_option("--n", options->n, "Measurements (30; for --recheck 12)")
      .check(whole_number_between(1, 1000));
  verb.add_flag("--recheck", options->recheck,
                "Poses of the calibration that tell best, measured again, what has changed");
  verb.add_option("--separate", options->separate,
                  "Two effects, as NAME[:JOINT+JOINT...][@KEY=NUMBER],NAME...")
      .type_name("A,B");
  verb.add_option("--payload", options->payloads,
                  "Loads that can be mounted to tell the two apart [kg] (those measured with; else "
                  "none and that of the cell)")
      .type_name("KG,KG...");
  verb.add_option("--box", options->boxes,
                  "Where the reflector may go, base frame [mm]; may be given again")
      .type_name("XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX");
  verb.add_option("--joint-limits", options->limits,
                  "Share of each joint's range to use, around its middle (100%)")
      .type_name("SHARE");
  verb.add_option("--pool", options->pool, "Random poses to choose from (5000)")
      .check(whole_number_between(10, 100000));
  verb.add_option("--seed", options->seed, "Seed of the random poses (1)").check(seed_number());
  verb.add_option("-o,--output", options->output, "CSV file to write (plan.csv)").type_name("FILE");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli

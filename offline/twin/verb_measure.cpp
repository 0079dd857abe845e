// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "cell/measurement_reader.hpp"
#include "program/file.hpp"
#include "program/output_files.hpp"
#include "program/shell_word.hpp"
#include "simulate/random.hpp"
#include "twin/change.hpp"
#include "twin/sister.hpp"
#include "twin/twin_file.hpp"
#include "twin/verbs.hpp"

namespace plumb::offline::twin {
namespace {

namespace fs = std::filesystem;

constexpr int kUsualPoses = 200, kMostPoses = 100000;
constexpr int kUsualRepeats = 3;
constexpr int kUsualDay = 1;

struct MeasureArguments {
  std::string directory, output;
  std::string poses = std::to_string(kUsualPoses);
  std::vector<std::string> changes;
  int repeats = 0;  // 0: the usual number, of planned poses 1
  std::uint64_t sister = 0, day = kUsualDay;
  WriteOptions write;

  /// The readings that the cell was made for, not others of the same arm or a sister.
  bool calibrates() const {
    return plan().empty() && changes.empty() && sister == 0 && day == kUsualDay;
  }
  /// The file of planned poses; empty: random ones, so many as poses says.
  std::string plan() const { return number() < 0 ? poses : ""; }
  int number() const {
    int out = -1;
    const char* const end = poses.data() + poses.size();
    const auto [rest, error] = std::from_chars(poses.data(), end, out);
    return rest == end && error == std::errc() ? out : -1;
  }
};

[[noreturn]] void usage(const std::string& message, const std::string& help) {
  throw Failure(Exit::kUsage, {.code = "E-USAGE", .message = message, .help = help});
}

void check(const MeasureArguments& options) {
  if (options.plan().empty() && (options.number() < 1 || options.number() > kMostPoses))
    usage(fmt::format("--poses {}: from 1 to {} poses are measured", options.poses, kMostPoses),
          "give their number, or a file of plumb plan: --poses plan.csv");
  if (!options.plan().empty() && options.repeats > 0)
    usage("a plan says itself which poses are read how often", "leave out --repeats");
  if (!options.calibrates() && options.output.empty())
    usage(
        "these readings are not those that the cell was made for, so they need a file of their own",
        "name it with -o: -o today.csv, of a sister -o arm2/measurements.csv");
}

Measurements planned_poses(const MeasureArguments& options, const Cell& cell, Outcome& outcome) {
  std::vector<bool> is_angle;
  for (const auto& row : cell.nominal.joints)
    is_angle.push_back(row.type == format::JointType::kRevolute);
  MeasurementFiles out = read_measurements({options.plan()}, is_angle, Needs::kJoints);
  outcome.inputs.push_back({options.plan(), sha256(read_file(options.plan()))});
  return out;
}

/// The payload that the plan states for each pose.
std::vector<StatedVisit> stated_of(const Measurements& planned) {
  const auto& payload = planned.context.payload;
  std::vector<StatedVisit> out(static_cast<std::size_t>(payload.rows()));
  for (Eigen::Index row = 0; row < payload.rows(); ++row)
    if (payload.row(row).allFinite())
      out[static_cast<std::size_t>(row)].payload =
          Payload{payload(row, 0), {payload(row, 1), payload(row, 2), payload(row, 3)}};
  return out;
}

HiddenTruth truth_now(const MeasureArguments& options, const Cell& cell, const Hidden& hidden) {
  HiddenTruth out =
      options.sister > 0 ? sister_of(cell, hidden, options.sister) : truth_of(cell, hidden);
  for (const auto& change : options.changes)
    apply(parse_change(change, cell, hidden.seed), cell, out);
  return out;
}

/// Another one for all that is not the calibration, so that poses and noise differ from it.
std::uint64_t seed_of(const MeasureArguments& options, const Hidden& hidden) {
  if (options.calibrates()) return hidden.seed;
  return sim::Random(hidden.seed, fmt::format("{} {} {} {}", options.poses, options.sister,
                                              options.day, fmt::join(options.changes, " ")))
      .bits();
}

Simulation measured(const MeasureArguments& options, const Cell& cell, const Hidden& hidden,
                    Outcome& outcome) {
  SimulationPlan plan;
  plan.noise_m = hidden.noise_m;
  plan.axes = hidden.axes;
  plan.seed = seed_of(options, hidden);
  plan.truth = truth_now(options, cell, hidden);
  if (options.plan().empty()) {
    plan.poses = options.number();
    plan.repeats = options.repeats > 0 ? options.repeats : kUsualRepeats;
    return simulate(cell, plan);
  }
  const Measurements planned = planned_poses(options, cell, outcome);
  plan.q = planned.q;
  plan.stated = stated_of(planned);
  Simulation out = simulate(cell, plan);
  out.measured.pose = planned.pose;
  return out;
}

std::string next_line(const MeasureArguments& options, const fs::path& file) {
  const std::string cell = shell_word(options.directory);
  if (options.calibrates()) return fmt::format("plumb -C {} diagnose --apply", cell);
  if (options.sister == 0)
    return fmt::format("plumb -C {} recheck --data {}", cell, shell_word(file.string()));
  const fs::path folder = file.parent_path().empty() ? "." : file.parent_path();
  return fmt::format("plumb -C {} fit --from {}", shell_word(folder.string()), cell);
}

std::string told(const MeasureArguments& options, const Hidden& hidden, std::size_t poses,
                 int rows) {
  const std::string of = options.sister > 0 ? fmt::format(" of sister {}", options.sister) : "";
  std::string out =
      fmt::format("The tracker read {} poses{} {} times in all, noise {} um per axis.\n", poses, of,
                  rows, hidden.noise_m * 1e6);
  if (!options.changes.empty())
    out += fmt::format("Changed since: {}.\n", fmt::join(options.changes, ", "));
  return out;
}

std::size_t distinct(const Simulation& simulation) {
  auto names = simulation.measured.pose;
  std::sort(names.begin(), names.end());
  return static_cast<std::size_t>(std::unique(names.begin(), names.end()) - names.begin());
}

void measure(const MeasureArguments& options, Outcome& outcome) {
  check(options);
  const fs::path folder = options.directory;
  const auto [cell, hidden] = open_folder(folder, outcome);
  const Simulation simulation = measured(options, cell, hidden, outcome);
  const fs::path file =
      options.output.empty() ? folder / "measurements.csv" : fs::path(options.output);
  OutputFiles files(options.sister > 0 ? file.parent_path() : fs::path());
  files.add(file, simulated_csv(cell, simulation));
  const fs::path own_cell = file.parent_path() / "cell.toml";
  if (options.sister > 0 && !fs::exists(own_cell))
    files.add(own_cell, write_cell(cell_of_sister(cell, options.sister, file)));
  const std::size_t poses = distinct(simulation);
  outcome.result = {{"rows", simulation.measured.size()}, {"poses", poses}};
  put(outcome.result, "noise_um", hidden.noise_m * 1e6);
  outcome.result["changes"] = options.changes;
  if (options.sister > 0) outcome.result["sister"] = options.sister;
  files.commit(options.write, outcome);
  outcome.text = fmt::format("{}\n  {}\n\nNext, type\n  {}\n",
                             told(options, hidden, poses, simulation.measured.size()),
                             wrote(file, options.write), next_line(options, file));
}

}  // namespace

void add_measure(Program& program) {
  const auto options = std::make_shared<MeasureArguments>();
  VerbOptions verb = program.verb(
      {.name = "measure",
       .summary = "The tracker reads the true arm at random or planned poses",
       .examples = "  plumb-twin measure mytwin\n"
                   "  plumb-twin measure mytwin --poses plan.csv --change encoder:J2=120urad "
                   "-o today.csv\n"
                   "  plumb-twin measure mytwin --sister 2 --poses 40 -o arm2/measurements.csv"},
      [options](const Globals&, Outcome& o) { measure(*options, o); });
  verb.add_option("DIR", options->directory, "Folder of the twin, or of a cell of plumb demo")
      .required();
  verb.add_option(
          "--poses", options->poses,
          "So many poses, uniform inside the joint limits, or those of a file of plumb plan")
      .type_name("N|FILE")
      .shows_default();
  verb.add_option("--change", options->changes,
                  "What has changed since: encoder:J2=120urad, stiffness:J3=-15%, tool=0.2mm, "
                  "base=0.3,0,-0.1mm; may be repeated")
      .type_name("CHANGE")
      .one_value_each();
  verb.add_option("--sister", options->sister,
                  "Measure another arm of the type; its cell.toml is written beside the output")
      .type_name("N")
      .check(whole_number_between(1, 1000000));
  verb.add_option("--day", options->day, "Measure again on another day: other noise")
      .type_name("N")
      .check(whole_number_between(1, 1000000))
      .shows_default();
  verb.add_option("--repeats", options->repeats, "Read every tenth random pose this many times (3)")
      .check(whole_number_between(1, 1000));
  verb.add_option("-o,--output", options->output, "Measurements; else measurements.csv in DIR")
      .type_name("FILE");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::twin

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cell/setups.hpp"
#include "cli/cell_data.hpp"
#include "cli/progress.hpp"
#include "cli/simulate_options.hpp"
#include "cli/verbs.hpp"
#include "simulate/hidden_effect_reader.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

Json sizes_json(const Simulation& simulation) {
  Json out = Json::array();
  for (std::size_t k = 0; k < simulation.effects.size(); ++k) {
    out.push_back({{"effect", simulation.effects[k].name},
                   {"visible_um", simulation.sizes[k].visible_m * 1e6},
                   {"rms_um", simulation.sizes[k].rms_m * 1e6}});
  }
  return out;
}

std::string sizes_text(const Simulation& simulation) {
  std::string out;
  if (!simulation.effects.empty()) {
    out = "  hidden, per-axis RMS [um]    all  visible after geometry is fitted\n";
  }
  for (std::size_t k = 0; k < simulation.effects.size(); ++k) {
    out += fmt::format("  {:<24} {:>7.1f}  {:>7.1f}\n", simulation.effects[k].name,
                       simulation.sizes[k].rms_m * 1e6, simulation.sizes[k].visible_m * 1e6);
  }
  return out.empty() ? out : out + "\n";
}

void list_effects(Outcome& outcome) {
  outcome.result = {{"effects", Json::array()}};
  outcome.text =
      "Effects that --effect takes, as NAME[=SIZE][:JOINT[=SIZE],...][:SIGMA][@KEY=NUMBER,...]\n"
      "SIGMA: visible size over the noise, geometry having been fitted\n\n";
  for (const auto& [name, line] : simulated_effects()) {
    outcome.result["effects"].push_back({{"effect", name}, {"about", line}});
    outcome.text += fmt::format("  {:<22} {}\n", name, line);
  }
}

/// The file into which the measurements go if none is named; of several set-ups that of the first.
fs::path usual_file(const Cell& cell) {
  const MeasurementSettings& m = cell.measurement;
  if (!m.setups.empty() && !m.setups.front().files.empty()) return m.setups.front().files.front();
  return m.files.empty() ? cell.directory / "measurements.csv" : m.files.front();
}

void note_setup(const Cell& cell, Outcome& outcome) {
  outcome.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-SIMULATE-SETUP",
       .message = fmt::format("simulated as measured in the first set-up, '{}'; the others have no "
                              "rows of this",
                              cell.measurement.setups.front().name),
       .help = "for each other set-up: a cell of its own with another --seed, and --output FILE"});
}

/// Absurd sizes lead to points that are kilometres away or not finite.
void require_finite(const Simulation& simulation) {
  constexpr double kFarthest_m = 1e3;
  const auto& points = simulation.measured.p_M;
  if (points.allFinite() && (points.size() == 0 || points.cwiseAbs().maxCoeff() < kFarthest_m))
    return;
  throw Failure(Exit::kUsage,
                {.code = "E-SIM-SIZE",
                 .message = "with errors of these sizes a measured point lies more than a "
                            "kilometre away, or is not a number",
                 .help = "give smaller sizes, as in --effect gear_ripple:J2=50urad --noise-um 10"});
}

void simulate_cell(const SimulateOptions& options, const Globals& globals, Outcome& outcome) {
  if (options.list) return list_effects(outcome);
  const Cell whole = open_cell(globals, outcome, Makes::kMeasurements);
  if (whole.measurement.setups.size() > 1) note_setup(whole, outcome);
  const Cell cell = cell_of_setup(whole, 0);
  const Progress progress(fmt::format("simulating {} poses", options.poses));
  const SimulationPlan plan = options.plan(cell);
  const Simulation simulation = simulate(cell, plan);
  require_finite(simulation);
  const fs::path data = options.output.empty() ? usual_file(cell) : fs::path(options.output);
  const fs::path truth =
      options.truth.empty() ? cell.directory / "truth.json" : fs::path(options.truth);
  OutputFiles files;
  files.add(data, simulated_csv(cell, simulation));
  files.add(truth, simulation.truth_json);
  if (!options.fresh.empty()) {
    const Simulation fresh = simulate(cell, options.fresh_plan(plan, simulation));
    require_finite(fresh);
    files.add(options.fresh, simulated_csv(cell, fresh));
  }
  outcome.result = {{"rows", simulation.measured.size()},
                    {"poses", options.poses},
                    {"noise_um", options.noise_um},
                    {"seed", options.seed},
                    {"hidden", options.hidden},
                    {"sizes", sizes_json(simulation)},
                    {"outliers", simulation.outliers.size()}};
  files.commit(options.write, outcome);
  outcome.text = fmt::format(
      "Simulated {} measurements of {} poses, noise {} um per axis.\n\n"
      "{}  {}\n  {}\n",
      simulation.measured.size(), options.poses, options.noise_um, sizes_text(simulation),
      wrote(data, options.write), wrote(truth, options.write));
  if (!options.fresh.empty()) {
    outcome.text += fmt::format("  {}\n", wrote(options.fresh, options.write));
  }
}

}  // namespace

void add_simulate(Program& program) {
  const auto options = std::make_shared<SimulateOptions>();
  VerbOptions verb = program.verb(
      {.name = "simulate",
       .summary = "Measurements of a simulated arm with chosen errors, hidden effects and noise",
       .examples = "  plumb -C mycell simulate --poses 150 --noise-um 10 --seed 7\n"
                   "  plumb -C mycell simulate --effect gear_ripple:J2:5 --outliers 2% --repeats 3",
       .in_cell = false},
      [options](const Globals& g, Outcome& o) { simulate_cell(*options, g, o); });
  options->add_to(verb);
}

}  // namespace plumb::offline::cli

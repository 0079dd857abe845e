// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "answers/kept_diagnosis.hpp"
#include "bench/benchmark.hpp"
#include "cli/cell_data.hpp"
#include "cli/progress.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "compile/compiler.hpp"
#include "diagnose/diagnosis.hpp"
#include "figures/bench_figures.hpp"
#include "figures/evidence_figure.hpp"
#include "figures/observability_figure.hpp"
#include "figures/registry.hpp"
#include "figures/run_figures.hpp"
#include "program/output_files.hpp"
#include "program/problem.hpp"
#include "runs/earlier_runs.hpp"
#include "runs/run_store.hpp"

namespace plumb::offline::cli {
namespace {

constexpr int kNextPoses = 30;       // of the figure observability, as plumb plan
constexpr long kTimedCalls = 20000;  // of each part of the cycle

struct PlotArguments {
  std::string name, output, run;
  int width = static_cast<int>(figures::kUsualWidth);  // [px]
  bool list = false;
  WriteOptions write;
};

void list_figures(Outcome& outcome) {
  outcome.result = {{"figures", Json::array()}};
  outcome.text = "Figures of plumb plot; JN stands for a joint such as J2:\n\n";
  for (const auto& row : figures::figure_list()) {
    outcome.result["figures"].push_back({{"name", row.name}, {"shows", row.shows}});
    outcome.text += fmt::format("  {:<19}  {}\n", row.name, row.shows);
  }
}

void check_name(const std::string& name, const Cell& cell) {
  const auto names = figures::figure_names(cell);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const auto near = did_you_mean(name, names);
  throw Failure(Exit::kUsage,
                {.code = "E-PLOT-NAME",
                 .message = name.empty() ? "which figure?"
                                         : fmt::format("this cell has no figure '{}'", name),
                 .help = near ? fmt::format("did you mean: plumb plot {}", *near)
                              : "list them: plumb plot --list"});
}

Run run_to_draw(const PlotArguments& options, const Cell& cell, const MeasurementFiles& measured) {
  if (!options.run.empty()) {
    Run run = load_run(cell, run_number(options.run));
    check_same_data(run, measured);
    return run;
  }
  if (auto run = current_run(cell, measured)) return std::move(*run);
  throw Failure(Exit::kInput,
                {.code = "E-PLOT-RUN",
                 .message = "there is no run of the present cell and data to draw",
                 .help = "plumb fit; or an earlier run: plumb plot " + options.name + " --run 1"});
}

std::string evidence_of(const PlotArguments& options, const Cell& cell,
                        const MeasurementFiles& measured) {
  if (!options.run.empty())
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = "evidence is of the present cell, not of a run: it judges what would "
                              "be added to it",
                   .help = "leave --run out: plumb plot " + options.name});
  if (const auto run = current_run(cell, measured))
    if (const auto kept = kept_diagnosis(*run))
      return figures::evidence(cell, *kept, options.width);
  Progress progress(fmt::format("diagnosing {} poses", measured.size()));
  const Diagnosis found =
      diagnose(cell, measured,
               {.apply = false, .tell = [&](const std::string& step) { progress.at(step); }});
  return figures::evidence(cell, found, options.width);
}

std::string planned(const figures::RunResults& results, int width) {
  return figures::observability_figure(figures::information_growth(results, kNextPoses),
                                       results.run.number, width);
}

std::string timed(const std::string& name, const Cell& cell, const Run& run, int width) {
  const format::Model model = compile(cell, run);
  const Progress progress("timing the cycle of the compiled run");
  const bench::Benchmark found = bench::benchmark(model, {.calls = kTimedCalls}, 1);
  return name == "latency" ? figures::latency_figure(found, width)
                           : figures::cost_figure(found, width);
}

std::string run_figure(const PlotArguments& options, const Cell& cell, MeasurementFiles& measured,
                       Outcome& outcome) {
  using Needs = figures::FigureRow::Needs;
  const Run run = run_to_draw(options, cell, measured);
  stand_on_base_of(run, cell, measured);
  outcome.result["run"] = run.number;
  const Needs needs = figures::needs_of(options.name);
  if (needs == Needs::kBench) return timed(options.name, cell, run, options.width);
  const auto results = figures::results_of(cell, measured, run);
  if (needs == Needs::kPlan) return planned(results, options.width);
  if (needs == Needs::kFits) {
    const Progress progress("fitting to fewer poses");
    return figures::poses_figure(results, options.width);
  }
  const auto earlier =
      needs == Needs::kEarlierRuns ? earlier_runs(run, cell, measured) : std::vector<Run>{};
  return figures::drawn(options.name, results, options.width, earlier).value();
}

void plot(const PlotArguments& options, const Globals& globals, Outcome& outcome) {
  if (options.list) return list_figures(outcome);
  Cell cell = open_cell(globals, outcome);
  check_name(options.name, cell);
  const std::string file = options.output.empty() ? options.name + ".svg" : options.output;
  OutputFiles before;
  before.add(file, "");
  before.check(options.write, outcome);
  MeasurementFiles measured = open_measurements(cell, outcome);
  outcome.result = {{"figure", options.name}, {"width_px", options.width}};
  OutputFiles files;
  const bool diagnosed = figures::needs_of(options.name) == figures::FigureRow::Needs::kDiagnosis;
  files.add(file, diagnosed ? evidence_of(options, cell, measured)
                            : run_figure(options, cell, measured, outcome));
  files.commit(options.write, outcome);
  outcome.text = wrote(file, options.write) + "\n";
}

}  // namespace

void add_plot(Program& program) {
  const auto options = std::make_shared<PlotArguments>();
  VerbOptions verb =
      program.verb({.name = "plot",
                    .summary = "One figure of a run as an SVG file",
                    .examples = "  plumb plot error-map -o map.svg      # of the latest run\n"
                                "  plumb plot --list                    # every figure"},
                   [options](const Globals& g, Outcome& o) { plot(*options, g, o); });
  verb.add_option("NAME", options->name, "The figure; JN in a listed name is a joint: joint-J2");
  verb.add_flag("--list", options->list, "List the figures and what they show");
  verb.add_option("-o,--output", options->output, "SVG file to write (NAME.svg)").type_name("FILE");
  verb.add_option("--run", options->run,
                  "A run by its number; else the one of the present cell and "
                  "data")
      .type_name("N");
  verb.add_option("--width", options->width, "Width [px] that the figure is laid out for")
      .check(whole_number_between(static_cast<int>(figures::kNarrowest),
                                  static_cast<int>(figures::kWidest)))
      .shows_default();
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "bench/benchmark.hpp"
#include "bench/machine.hpp"
#include "cli/cell_data.hpp"
#include "cli/model_file.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "figures/bench_figures.hpp"
#include "figures/registry.hpp"
#include "fit/verdict.hpp"
#include "program/output_files.hpp"
#include "show/latency_view.hpp"

namespace plumb::offline::cli {
namespace {

struct BenchArguments {
  std::string model, figure;
  bench::TimingRequest request;
  std::uint64_t seed = 1;
  std::optional<double> max_us;
  WriteOptions write;
};

/// Checked before the timing, which takes seconds.
void refuse_existing(const BenchArguments& options, const Outcome& outcome) {
  if (options.figure.empty()) return;
  OutputFiles files;
  files.add(options.figure, "");
  files.check(options.write, outcome);
}

bench::Benchmark timed(const BenchArguments& options, const format::Model& model) {
  const Progress progress(fmt::format("timing the cycle of {}", options.model));
  return bench::benchmark(model, options.request, options.seed);
}

void remark_on(const bench::Benchmark& found, Outcome& outcome) {
  if (found.timings.allocations == 0) return;
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-BENCH-HEAP",
       .message = fmt::format("the cycle took memory from the heap {} times, which it must not",
                              found.timings.allocations),
       .help = "this is a bug of plumb: report it with the model file"});
}

bool passes(const BenchArguments& options, const bench::Benchmark& found, Outcome& outcome) {
  const double median_us = 1e-3 * found.cycle().median();
  if (!options.max_us || median_us <= *options.max_us) return true;
  outcome.exit = Exit::kGateFailed;
  outcome.errors.push_back(
      {.code = "E-GATE-TIME",
       .message = fmt::format("the median of a whole step, {:.3g} us, exceeds --max-us {:g}",
                              median_us, *options.max_us),
       .help = "see what costs it in the table: plumb bench " + options.model});
  return false;
}

void draw(const BenchArguments& options, const bench::Benchmark& found, Outcome& outcome) {
  OutputFiles files;
  files.add(options.figure, figures::latency_figure(found, figures::kUsualWidth));
  files.commit(options.write, outcome);
  outcome.text += "\n" + wrote(options.figure, options.write) + "\n";
}

void bench_model(const BenchArguments& options, const Globals& globals, Outcome& outcome) {
  keep_cells_around(globals, options.figure, outcome);
  const format::Model model = open_model(options.model, outcome);
  refuse_existing(options, outcome);
  const bench::Benchmark found = timed(options, model);
  outcome.result = show::bench_json(found);
  if (!found.why_not_representative.empty())
    outcome.verdicts = {
        {bench::fitness_text(found.why_not_representative), name_of(Grade::kPartly)}};
  outcome.text = show::bench_text(found);
  remark_on(found, outcome);
  if (passes(options, found, outcome) && !options.figure.empty()) draw(options, found, outcome);
}

}  // namespace

void add_bench(Program& program) {
  const auto options = std::make_shared<BenchArguments>();
  VerbOptions verb =
      program.verb({.name = "bench",
                    .summary = "How long a cycle takes, and what each effect of the model costs",
                    .examples = "  plumb bench robot.plumb\n"
                                "  plumb bench robot.plumb --max-us 10 -o latency.svg --json",
                    .in_cell = false},
                   [options](const Globals& g, Outcome& o) { bench_model(*options, g, o); });
  verb.add_option("MODEL", options->model, "Model file of plumb compile").required();
  verb.add_option(
          "--calls", options->request.calls,
          "Calls of each part of the cycle; a hundredth of them, at most 1000, with cold caches")
      .check(whole_number_between(1L, bench::TimingRequest::kMostCalls))
      .shows_default();
  verb.add_option("--seed", options->seed, "Seed of the random poses")
      .check(seed_number())
      .shows_default();
  verb.add_option("--max-us", options->max_us,
                  "Gate: exit 1 if a whole step takes longer than this in the median")
      .type_name("US")
      .check(greater_than_zero());
  const Option figure =
      verb.add_option("-o,--output", options->figure, "SVG file: histogram of the latency")
          .type_name("FILE");
  options->write.add_to(verb);
  for (const char* flag : {"--force", "--dry-run"}) verb.get_option(flag).needs(figure);
}

}  // namespace plumb::offline::cli

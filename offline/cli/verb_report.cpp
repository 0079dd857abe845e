// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "answers/answers.hpp"
#include "answers/kept_diagnosis.hpp"
#include "cell/iso_time.hpp"
#include "cli/cell_data.hpp"
#include "cli/model_limits.hpp"
#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "compare/comparison.hpp"
#include "compile/compiler.hpp"
#include "deploy/bus_of_cell.hpp"
#include "fit/verdict.hpp"
#include "program/file.hpp"
#include "program/output_files.hpp"
#include "program/shell_word.hpp"
#include "report/pdf.hpp"
#include "report/report.hpp"
#include "runs/earlier_runs.hpp"
#include "runs/run_store.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string output, run;
  bool pdf = false, no_diagnosis = false;
  WriteOptions write;
};

/// What a person is told of why a part is missing.
std::string first_message(const Failure& failure) {
  return failure.problems().empty() ? failure.what() : failure.problems().front().message;
}

Run run_to_report(const ReportArguments& options, const Cell& cell,
                  const MeasurementFiles& measured, Outcome& outcome) {
  if (options.run.empty())
    return current_or_new_run(cell, measured, options.write.dry_run ? Keep::kNothing : Keep::kRun,
                              outcome);
  Run run = load_run(cell, run_number(options.run));
  check_same_data(run, measured);
  if (static_cast<int>(run.fit.calibration.state.arm.calibrated.joints.size()) != cell.joints())
    throw Failure(Exit::kInput,
                  {.code = "E-RUN-DATA",
                   .message = fmt::format("run {} is of an arm with another number of "
                                          "joints than the present cell.toml",
                                          run.number),
                   .help = "report the present cell: plumb report"});
  return run;
}

/// What was found before, or is found now and kept for the next report.
void diagnose_for(const ReportArguments& options, report::ReportData& data, Outcome& outcome) {
  if ((data.diagnosis = kept_diagnosis(data.run))) {
    data.diagnosis_is_kept = true;
    return;
  }
  if (options.no_diagnosis) {
    data.why_no_diagnosis =
        "Not diagnosed: what is missing was not searched for. plumb diagnose searches, and plumb "
        "report then shows what it found.";
    return;
  }
  if (!data.run_is_current) {
    data.why_no_diagnosis = fmt::format(
        "Run {} is of another cell.toml than the present one, and no diagnosis was kept with it: "
        "what it lacks cannot be searched for any more.",
        data.run.number);
    return;
  }
  try {
    Progress progress(fmt::format("diagnosing {} poses", data.measured.size()));
    data.diagnosis =
        diagnose(data.cell, data.measured,
                 {.apply = false, .tell = [&](const std::string& step) { progress.at(step); }});
    outcome.remark(data.diagnosis->remarks);
    if (!options.write.dry_run) keep_diagnosis(data.run, *data.diagnosis);
  } catch (const Failure& failure) {
    data.why_no_diagnosis = "These data cannot be diagnosed: " + first_message(failure) + ".";
  }
}

void compile_for(report::ReportData& data) {
  try {
    check_known_to_runtime(data.run, data.measured);
    format::Model model = compile(data.cell, data.run);
    check_effect_sizes(model.effects);
    check_parameter_count(model);
    Audit found = audit(model);
    data.controller = {std::move(model), std::move(found)};
  } catch (const Failure& failure) {
    data.why_no_controller = "This run cannot be compiled: " + first_message(failure) + ".";
  }
  try {
    data.bus = bus_of(data.cell, data.cell.deploy.link);
  } catch (const Failure& failure) {
    data.why_no_bus = "The bus of [deploy] cannot be used: " + first_message(failure) + ".";
  }
}

std::vector<std::string> commands_of(const ReportArguments& options, const Globals& globals,
                                     const report::ReportData& data, const std::string& file) {
  std::vector<std::string> out;
  if (data.run_is_current)
    out.push_back(
        to_type(globals, data.run.fit.base == Base::kController ? "fit --base controller" : "fit"));
  out.push_back(to_type(globals, "report -o " + shell_word(file) +
                                     (options.run.empty() ? "" : " --run " + options.run) +
                                     (options.no_diagnosis ? " --no-diagnosis" : "")));
  return out;
}

void put_result(const ReportArguments& options, const report::ReportData& data,
                const report::Report& made, const std::string& file, const std::string& pdf,
                Outcome& outcome) {
  Json& out = outcome.result;
  out = {{"report", file}, {"bytes", made.html.size()}, {"pages", made.pages}};
  if (data.run.number > 0)
    out["run"] = data.run.number;
  else
    put_null(out, "run", "--dry-run keeps nothing");
  out["verdict"] = made.verdict;
  out["finding"] = to_json(data.answers);
  if (made.good)
    out["good"] = *made.good;
  else
    put_null(out, "good", "no pose was held out");
  if (options.pdf)
    out["pdf"] = pdf;
  else
    put_null(out, "pdf", "--pdf was not given");
  if (data.diagnosis)
    out["diagnosis"] = data.diagnosis_is_kept ? "kept" : "new";
  else
    put_null(out, "diagnosis", data.why_no_diagnosis);
}

void write_report(const ReportArguments& options, const Globals& globals, Outcome& outcome) {
  std::optional<fs::path> browser;
  if (options.pdf) browser = report::find_browser();
  Cell cell = open_cell(globals, outcome);
  const std::string file = options.output.empty() ? "report.html" : options.output;
  const std::string pdf = options.pdf ? fs::path(file).replace_extension(".pdf").string() : "";
  OutputFiles before;
  before.add(file, "");
  if (options.pdf) before.add(pdf, "");
  before.check(options.write, outcome);
  MeasurementFiles measured = open_measurements(cell, outcome);
  const Run run = run_to_report(options, cell, measured, outcome);
  stand_on_base_of(run, cell, measured);
  const auto results = figures::results_of(cell, measured, run);
  const auto comparison = compare::comparison(cell, measured, run.fit);
  report::ReportData data{
      .cell = cell, .measured = measured, .run = run, .results = results, .comparison = comparison};
  data.run_is_current = state_of(run, cell, measured) == show::ListedRun::State::kCurrent;
  data.earlier = earlier_runs(run, cell, measured);
  data.created = iso_utc(std::time(nullptr));
  diagnose_for(options, data, outcome);
  data.answers = answers_of(cell, measured, run.fit, data.diagnosis ? &*data.diagnosis : nullptr);
  compile_for(data);
  data.commands = commands_of(options, globals, data, file);
  Progress progress("writing the report");
  const report::Report made = report::make_report(data);
  put_result(options, data, made, file, pdf, outcome);
  OutputFiles files;
  files.add(file, made.html);
  if (browser) {
    progress.at("printing it to PDF");
    files.add(pdf, report::printed_pdf(*browser, made.html));
  }
  files.commit(options.write, outcome);
  outcome.verdicts = {{made.verdict, name_of(grade(run.fit, cell.tolerance_m))}};
  outcome.text = made.verdict + "\n\n" + wrote(file, options.write) +
                 fmt::format(" ({:.0f} kB, {} pages)\n",
                             static_cast<double>(made.html.size()) / 1e3, made.pages);
  if (options.pdf) outcome.text += wrote(pdf, options.write) + "\n";
  if (data.diagnosis_is_kept)
    outcome.text +=
        fmt::format("Its diagnosis was made earlier and kept with run {}.\n", run.number);
  say_next(globals, data.answers.next, outcome);
}

}  // namespace

void add_report(Program& program) {
  const auto options = std::make_shared<ReportArguments>();
  VerbOptions verb = program.verb(
      {.name = "report",
       .summary =
           "One self-contained HTML file: verdict, figures, evidence, model, how to reproduce",
       .examples = "  plumb report -o report.html          # of the present cell and data\n"
                   "  plumb report --run 2 --pdf           # an earlier run, and printed to A4\n"
                   "  plumb report --no-diagnosis          # at once, without a search for causes"},
      [options](const Globals& g, Outcome& o) { write_report(*options, g, o); });
  verb.add_option("-o,--output", options->output, "HTML file to write (report.html)")
      .type_name("FILE");
  verb.add_option("--run", options->run,
                  "A run by its number; else the one of the present cell and data")
      .type_name("N");
  verb.add_flag("--pdf", options->pdf,
                "Also print it to a PDF file of the same name, with Chromium or Chrome");
  verb.add_flag("--no-diagnosis", options->no_diagnosis,
                "Do not search for missing effects; what an earlier search found is shown");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/cell_data.hpp"
#include "cli/csv_output.hpp"
#include "cli/model_file.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "fit/controller_base.hpp"
#include "fit/effect_binding.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

struct Options {
  std::string model, data, run;
  bool as_measured = false;
  CsvOutput output;
};

std::span<const double> joints(const Measurements& rows, int i) {
  return {rows.q.row(i).data(), static_cast<std::size_t>(rows.q.cols())};
}

[[noreturn]] void usage(const std::string& message, const std::string& help) {
  throw Failure(Exit::kUsage, {.code = "E-USAGE", .message = message, .help = help});
}

void check(const Options& options, const Globals& globals) {
  check_output(options.output, globals);
  if (options.as_measured && !options.model.empty())
    usage("--as-measured takes no model file: a run makes it",
          "plumb predict --as-measured -o out.csv");
  if (!options.as_measured && !options.run.empty())
    usage("--run belongs to --as-measured", "plumb predict --as-measured --run 2 -o out.csv");
  if (!options.as_measured && (options.model.empty() || options.data.empty()))
    usage("predict needs a model file and --data",
          "plumb predict robot.plumb --data poses.csv -o out.csv");
}

void set_points(const Rows3& p, show::CsvColumns& columns) {
  const char* const names[] = {"px_mm", "py_mm", "pz_mm"};
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < p.rows(); ++i) values.push_back(show::to_mm(p(i, k)));
    columns.set(names[k], values);
  }
}

void set_quaternions(const Rows4& q, show::CsvColumns& columns) {
  const char* const names[] = {"pqw", "pqx", "pqy", "pqz"};
  for (int k = 0; k < 4; ++k) {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < q.rows(); ++i) values.push_back(q(i, k));
    columns.set(names[k], values);
  }
}

void finish(const Options& options, const std::vector<Status>& status, const std::string& verdict,
            show::CsvColumns& columns, Outcome& outcome) {
  columns.set("status", status_texts(status));
  outcome.result["rows"] = status.size();
  outcome.result["status"] = status_counts(status);
  deliver(columns, options.output, verdict + "\n" + status_summary(status), outcome);
}

/// The tool centre point in the base frame, through the runtime.
void predict_model(const Options& options, Outcome& outcome) {
  const format::Model model = open_model(options.model, outcome);
  const Measurements rows = open_rows(options.data, model.nominal, outcome);
  const ForwardModel arm(model);
  const auto sensors = temperature_names(model);
  Rows3 p(rows.size(), 3);
  Rows4 q(rows.size(), 4);
  std::vector<Status> status;
  for (int i = 0; i < rows.size(); ++i) {
    const Prediction predicted = arm.predict(joints(rows, i), context_at(rows.context, i, sensors));
    const format::Pose pose = to_pose(predicted.X_BT);
    p.row(i) << pose.p[0], pose.p[1], pose.p[2];
    q.row(i) << pose.q[0], pose.q[1], pose.q[2], pose.q[3];
    status.push_back(predicted.status);
  }
  show::CsvColumns columns(rows.tables);
  set_points(p, columns);
  set_quaternions(q, columns);
  outcome.result = {{"frame", "base"}, {"point", "tool centre point"}};
  finish(options, status,
         fmt::format("Predicted the tool centre point of {} rows in the base frame.", rows.size()),
         columns, outcome);
}

std::string set_name(const Split& split, int i) {
  if (!split.used[i]) return "ignore";
  return split.held[i] || split.fold[i] >= 0 ? "held" : "fit";
}

void set_split(const Split& split, show::CsvColumns& columns) {
  std::vector<std::string> set, fold;
  for (std::size_t i = 0; i < split.used.size(); ++i) {
    set.push_back(set_name(split, static_cast<int>(i)));
    fold.push_back(std::to_string(split.fold[i]));
  }
  columns.set("set", std::move(set));
  columns.set("fold", std::move(fold));
}

Run chosen_run(const Options& options, const Cell& cell, const Measurements& measured,
               Outcome& outcome) {
  const auto keep_it = options.output.write.dry_run ? Keep::kNothing : Keep::kRun;
  if (options.run.empty()) return current_or_new_run(cell, measured, keep_it, outcome);
  Run run = load_run(cell, run_number(options.run));
  if (options.data.empty()) check_same_data(run, measured);
  return run;
}

std::vector<Status> domain_status(const Run& run, const Measurements& rows) {
  const ForwardModel arm(run.fit.calibration.state.arm);
  const auto sensors = temperature_names(run.fit.calibration.state.arm);
  std::vector<Status> out;
  for (int i = 0; i < rows.size(); ++i)
    out.push_back(arm.predict(joints(rows, i), context_at(rows.context, i, sensors)).status);
  return out;
}

/// The measured point in the measurement frame: held-out poses by models that never saw them.
void predict_as_measured(const Options& options, const Globals& globals, Outcome& outcome) {
  const Cell cell = open_cell(globals, outcome);
  const Measurements measured = open_measurements(cell, outcome);
  const Run run = chosen_run(options, cell, measured, outcome);
  const bool own = options.data.empty();
  Measurements rows = own ? measured : open_rows(options.data, cell.nominal, outcome);
  if (!own && run.fit.base == Base::kController) {
    check_same_data(run, measured);
    stand_on_controller(cell, measured, rows);
  }
  show::CsvColumns columns(rows.tables);
  set_points(own ? run.fit.predicted_M : predict_points(run.fit.calibration.state, rows), columns);
  if (own) set_split(run.fit.split, columns);
  outcome.result = {{"frame", "measurement"}, {"point", "target"}, {"run", run.number}};
  finish(options, domain_status(run, rows),
         fmt::format("Predicted the measured point of {} rows in the measurement frame, run {}.",
                     rows.size(), run.number),
         columns, outcome);
}

void predict(const Options& options, const Globals& globals, Outcome& outcome) {
  check(options, globals);
  if (options.as_measured)
    predict_as_measured(options, globals, outcome);
  else
    predict_model(options, outcome);
}

}  // namespace

void add_predict(Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App& verb = program.verb(
      {.name = "predict",
       .summary = "Where the arm truly is: forward model through the runtime's own code",
       .examples =
           "  plumb predict robot.plumb --data poses.csv -o predicted.csv\n"
           "  plumb predict --as-measured -o predicted.csv   # as the tracker would see it"},
      [options](const Globals& g, Outcome& o) { predict(*options, g, o); });
  verb.add_option("MODEL", options->model, "Model file of plumb compile");
  verb.add_option("--data", options->data, "CSV file with columns q1_deg ...")->type_name("FILE");
  verb.add_flag("--as-measured", options->as_measured,
                "No model file: a run predicts the measured point in the measurement's frame");
  verb.add_option("--run", options->run, "Run for --as-measured; else the latest")->type_name("N");
  options->output.add_to(verb);
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "arm/effect_binding.hpp"
#include "arm/known_inputs.hpp"
#include "arm/measured_arm.hpp"
#include "arm/predicted_points.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/setups.hpp"
#include "cli/cell_data.hpp"
#include "cli/csv_output.hpp"
#include "cli/joint_units.hpp"
#include "cli/model_file.hpp"
#include "cli/row_stream.hpp"
#include "cli/run_number.hpp"
#include "cli/verbs.hpp"
#include "fit/controller_base.hpp"
#include "noise/series_place.hpp"
#include "plumb/runtime/single_poses.hpp"
#include "program/counted_words.hpp"
#include "runs/run_store.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

struct PredictArguments {
  std::string model, data, run;
  bool as_measured = false;
  CsvOutput output;
};

std::span<const double> joints(const MeasurementFiles& rows, int i) {
  return {rows.q.row(i).data(), static_cast<std::size_t>(rows.q.cols())};
}

[[noreturn]] void predict_usage(const std::string& message, const std::string& help) {
  throw Failure(Exit::kUsage, {.code = "E-USAGE", .message = message, .help = help});
}

void check(const PredictArguments& options, const Globals& globals) {
  check_output(options.output, globals);
  if (options.as_measured && !options.model.empty())
    predict_usage("--as-measured takes no model file: a run makes it",
                  "plumb predict --as-measured -o out.csv");
  if (!options.as_measured && !options.run.empty())
    predict_usage("--run belongs to --as-measured",
                  "plumb predict --as-measured --run 2 -o out.csv");
  if (!options.as_measured && (options.model.empty() || options.data.empty()))
    predict_usage("predict needs a model file and --data",
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

/// The prediction of a row and its status, for both ways of predicting. `placed`: whether the row
/// has a place in the order of the cell's own measurements.
Prediction predicted_row(const MeasuredArm& arm, const MeasurementFiles& rows, int i,
                         const std::vector<std::string>& sensors, bool placed,
                         KnownInputs& inputs) {
  const MeasuredContext context = context_at(rows.context, i, sensors);
  Prediction out = arm.predict(joints(rows, i), context);
  out.status = inputs.mark(joints(rows, i), context, placed, out.status);
  return out;
}

/// The tool centre point of rows, through the runtime.
class ModelRows {
 public:
  explicit ModelRows(const format::Model& model)
      : joints_(model.nominal),
        poses_(model),
        unused_(model),
        inputs_(model),
        unread_(model),
        units_(model),
        sensors_(temperature_names(model)) {}

  static std::vector<std::string> columns() {
    return {"px_mm", "py_mm", "pz_mm", "pqw", "pqx", "pqy", "pqz", "status"};
  }

  RowStream::Computed compute(Table table, const show::PassThrough& columns) {
    MeasurementFiles rows = plain_rows(std::move(table), joints_);
    StatusCounts counts;
    KnownInputs inputs = unused_;
    JointUnits units = unread_;
    units.name_column(rows.tables.front());
    std::string text;
    for (int i = 0; i < rows.size(); ++i) {
      units.add(joints(rows, i));
      append(rows, i, columns, counts, inputs, text);
    }
    return {.remarks = std::move(rows.tables.front().remarks),
            .append = [this, counts, inputs, units, text = std::move(text)](std::string& out) {
              counts_.add(counts);
              inputs_.add(inputs);
              units_.add(units);
              out += text;
            }};
  }

  const StatusCounts& counts() const { return counts_; }

  /// What was found out about all rows.
  std::vector<Problem> remarks() const {
    std::vector<Problem> out = inputs_.remarks();
    if (auto limited = of_limited()) out.push_back(std::move(*limited));
    if (auto radians = units_.remark()) out.push_back(std::move(*radians));
    return out;
  }

 private:
  std::optional<Problem> of_limited() const {
    const std::size_t limited = counts_.of(Status::kLimited);
    if (limited == 0) return std::nullopt;
    return Problem{
        .severity = Severity::kWarning,
        .code = "W-PREDICT-LIMITED",
        .message = fmt::format("in {} of {} rows the arm is farther from its nominal pose than "
                               "the guard lets a correction be ({} mm): the prediction is whole, "
                               "but correct and plumb-rt would cut the correction there",
                               limited, counts_.rows(),
                               show::mm(poses_.corrector().limits().max_correction_m)),
        .help = "raise max_correction_mm under [deploy] in cell.toml, then: plumb compile"};
  }

  void append(const MeasurementFiles& rows, int i, const show::PassThrough& columns,
              StatusCounts& counts, KnownInputs& inputs, std::string& text) const {
    const MeasuredContext context = context_at(rows.context, i, sensors_);
    Prediction predicted = poses_.predict(joints(rows, i), context.known);
    predicted.status = inputs.mark(joints(rows, i), context, true, predicted.status);
    const format::Pose pose = to_pose(predicted.X_BT);
    RowCells cells;
    for (const double p : pose.p) cells.add(show::to_mm(p));
    for (const double q : pose.q) cells.add(q);
    cells.add(to_string(predicted.status));
    counts.add(predicted.status);
    columns.append(rows.tables.front().raw_rows.view(static_cast<std::size_t>(i)), cells.cells(),
                   text);
  }

  JointColumns joints_;
  SinglePoses poses_;
  KnownInputs unused_;  // without any row
  KnownInputs inputs_;
  JointUnits unread_;  // without any row
  JointUnits units_;
  std::vector<std::string> sensors_;
  StatusCounts counts_;
};

/// The tool centre point in the base frame, through the runtime.
void predict_model(const PredictArguments& options, const Globals& globals, Outcome& outcome) {
  keep_cells_around(globals, options.output.file, outcome);
  const format::Model model = open_model(options.model, outcome);
  ModelRows rows(model);
  RowStream stream(options.data, ModelRows::columns(), options.output, outcome);
  stream.run(
      [&](Table table, const show::PassThrough& columns) {
        return rows.compute(std::move(table), columns);
      },
      outcome);
  outcome.remark(rows.remarks());
  const StatusCounts& counts = rows.counts();
  outcome.result = {{"frame", "base"}, {"point", "tool centre point"}};
  outcome.result["rows"] = counts.rows();
  outcome.result["status"] = to_json(counts);
  stream.deliver(
      fmt::format("Predicted the tool centre point (px, py, pz) of {} in the base frame.\n{}",
                  counted_words(counts.rows(), "row", "rows"), status_summary(counts)),
      outcome);
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

Run chosen_run(const PredictArguments& options, const Cell& cell, const MeasurementFiles& measured,
               Outcome& outcome) {
  const auto keep_it = options.output.write.dry_run ? Keep::kNothing : Keep::kRun;
  if (options.run.empty()) return current_or_new_run(cell, measured, keep_it, outcome);
  Run run = load_run(cell, run_number(options.run));
  if (options.data.empty()) check_same_data(run, measured);
  return run;
}

struct RowStatus {
  std::vector<Status> rows;
  int without_place = 0;  // an effect needs their place in the cell's own series, nothing tells it
};

/// `placed`: which rows have a place in the order of the cell's own measurements.
RowStatus domain_status(const Run& run, const MeasurementFiles& rows,
                        const std::vector<bool>& placed, Outcome& outcome) {
  const format::Model& model = run.fit.calibration.state.arm;
  const MeasuredArm arm(model);
  const auto sensors = temperature_names(model);
  KnownInputs inputs(model);
  JointUnits units(model);
  if (!rows.tables.empty()) units.name_column(rows.tables.front());
  RowStatus out;
  for (int i = 0; i < rows.size(); ++i) {
    units.add(joints(rows, i));
    out.rows.push_back(
        predicted_row(arm, rows, i, sensors, placed[static_cast<std::size_t>(i)], inputs).status);
  }
  outcome.remark(inputs.remarks());
  if (auto radians = units.remark()) outcome.remark({std::move(*radians)});
  out.without_place = inputs.without_place();
  return out;
}

std::string place_words(int without_place) {
  if (without_place == 0) return "";
  return fmt::format("; {} as if measured after the cell's own last one, for nothing tells when",
                     counted_words(without_place, "row", "rows"));
}

void finish(const PredictArguments& options, const std::vector<Status>& status,
            const std::string& verdict, show::CsvColumns& columns, Outcome& outcome) {
  StatusCounts counts;
  std::vector<std::string> texts;
  for (const Status s : status) {
    counts.add(s);
    texts.emplace_back(to_string(s));
  }
  columns.set("status", std::move(texts));
  outcome.result["rows"] = status.size();
  outcome.result["status"] = to_json(counts);
  deliver(columns, options.output, verdict + "\n" + status_summary(counts), outcome);
}

/// The measured point in the measurement frame: held-out poses by models that never saw them.
void predict_as_measured(const PredictArguments& options, const Globals& globals,
                         Outcome& outcome) {
  Cell cell = open_cell(globals, outcome);
  refuse_existing(options.output, outcome);
  const MeasurementFiles measured = open_measurements(cell, outcome);
  const Run run = chosen_run(options, cell, measured, outcome);
  const bool own = options.data.empty();
  MeasurementFiles rows = own ? measured : open_rows(options.data, cell.nominal, outcome);
  if (!own) assign_setups_to_predict(cell, options.data, rows);
  if (!own && run.fit.base == Base::kController) {
    check_same_data(run, measured);
    stand_on_controller(cell, measured, rows);
  }
  const std::vector<bool> placed =
      own ? std::vector<bool>(static_cast<std::size_t>(rows.size()), true)
          : SeriesPlace(measured).place(rows);
  show::CsvColumns columns(rows.tables);
  set_points(own ? run.fit.predicted_M : predict_points(run.fit.calibration.state, rows), columns);
  if (own) set_split(run.fit.split, columns);
  const RowStatus status = domain_status(run, rows, placed, outcome);
  outcome.result = {{"frame", "measurement"},
                    {"point", "target"},
                    {"run", run.number},
                    {"rows_without_place", status.without_place}};
  finish(options, status.rows,
         fmt::format("Predicted the measured point of {} in the measurement frame, run {}{}.",
                     counted_words(rows.size(), "row", "rows"), run.number,
                     place_words(status.without_place)),
         columns, outcome);
}

void predict(const PredictArguments& options, const Globals& globals, Outcome& outcome) {
  check(options, globals);
  if (options.as_measured)
    predict_as_measured(options, globals, outcome);
  else
    predict_model(options, globals, outcome);
}

}  // namespace

void add_predict(Program& program) {
  const auto options = std::make_shared<PredictArguments>();
  VerbOptions verb = program.verb(
      {.name = "predict",
       .summary = "Where the arm truly is: forward model through the runtime's own code",
       .examples = "  plumb predict robot.plumb --data poses.csv -o predicted.csv\n"
                   "  plumb predict --as-measured -o predicted.csv   # as the tracker would see it",
       .in_cell = false},
      [options](const Globals& g, Outcome& o) { predict(*options, g, o); });
  verb.add_option("MODEL", options->model, "Model file of plumb compile");
  verb.add_option("--data", options->data, "CSV file with columns q1_deg ...").type_name("FILE");
  verb.add_flag("--as-measured", options->as_measured,
                "No model file: a run predicts the measured point in the measurement's frame");
  verb.add_option("--run", options->run, "Run for --as-measured; else the latest").type_name("N");
  options->output.add_to(verb);
}

}  // namespace plumb::offline::cli

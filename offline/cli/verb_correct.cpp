// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/cell_data.hpp"
#include "cli/csv_output.hpp"
#include "cli/model_file.hpp"
#include "cli/start_joints.hpp"
#include "cli/target_rows.hpp"
#include "cli/verbs.hpp"
#include "compile/tool_uncertainty.hpp"
#include "show/audit_view.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kTurned_rad = 1e-9;  // less is rounding: orientations are not corrected

struct CorrectArguments {
  std::string model, data;
  std::optional<std::string> start;  // deg or mm, with commas between
  CsvOutput output;
};

auto corrected_rows(const TargetTotals& found) {
  return found.counts.rows() - found.counts.refused_rows() - found.faded;
}

/// "Corrected 7 of 20 targets: 13 lie near a singular pose ... (metres in x_mm?)"
std::string verdict(const TargetTotals& found) {
  const auto rows = found.counts.rows(), refused = found.counts.refused_rows();
  std::string out = fmt::format("Corrected {} of {} targets", corrected_rows(found), rows);
  if (found.faded > 0)
    out += fmt::format("; {} so far outside what was fitted that nothing is corrected",
                       found.faded == 1 ? "1 lies" : fmt::format("{} lie", found.faded));
  if (refused == 0) return out;
  out += (found.faded > 0 ? "; " : ": ") + found.refusals.words();
  if (const auto guess = found.refusals.likely_mistake(); !guess.empty()) out += " (" + guess + ")";
  return out;
}

void judge(const TargetTotals& found, Outcome& outcome) {
  const auto rows = found.counts.rows(), refused = found.counts.refused_rows();
  outcome.remark(limited_remark(found));
  outcome.remark(found.inputs.remarks());
  if (refused == 0 && corrected_rows(found) > 0) return;
  if (corrected_rows(found) > 0) {
    const auto guess = found.refusals.likely_mistake();
    outcome.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-CORRECT-REFUSED",
         .message =
             fmt::format("{} of {} targets were refused, their command is the target itself: "
                         "{}{}",
                         refused, rows, found.refusals.words(), guess.empty() ? "" : "; " + guess),
         .help = fmt::format("see the column status, and: plumb explain {}",
                             to_string(found.refusals.commonest()))});
    return;
  }
  outcome.exit = Exit::kNumbersSayNo;
  outcome.errors.push_back({.code = "E-CORRECT-NONE",
                            .message = verdict(found),
                            .help = "compare x_mm ... and q1_deg ... of one row with the "
                                    "controller's own display"});
}

Json refused_json(const StatusCounts& counts) {
  Json out = Json::object();
  for (const auto& [order, entry] : counts.all())
    if (refused(entry.first)) out[to_string(entry.first)] = entry.second;
  return out;
}

void put_mistake(const TargetTotals& found, Json& result) {
  if (const auto guess = found.refusals.likely_mistake(); !guess.empty())
    result["likely_mistake"] = guess;
  else
    put_null(result, "likely_mistake",
             found.refusals.rows() == 0 ? "no target was refused"
                                        : "no single mistake explains the refused targets");
}

/// Empty where orientations were measured, or the model does not say how sure it is.
std::string orientation_words(const format::Model& model) {
  const ToolUncertainty tool = tool_uncertainty(model);
  if (!tool.turn_unmeasured) return "";
  return "The uncertain orientation of the tool adds " + show::beside_words(tool) + ".\n";
}

std::string summary(const TargetTotals& found, const format::Model& model) {
  std::string out = verdict(found);
  if (found.counts.refused_rows() < found.counts.rows())
    out += found.largest_rad > kTurned_rad
               ? fmt::format("; the largest correction is {} mm and {:.4f} deg",
                             show::mm(found.largest_m), show::to_deg(found.largest_rad))
               : fmt::format("; the largest correction is {} mm, orientations are left as they are",
                             show::mm(found.largest_m));
  return out + ".\n" + orientation_words(model) + status_summary(found.counts);
}

void correct(const CorrectArguments& options, const Globals& globals, Outcome& outcome) {
  check_output(options.output, globals);
  const format::Model model = open_model(options.model, outcome);
  keep_cells_around(globals, options.output.file, outcome);
  TargetRows rows(model, start_of(options.start, model.nominal));
  RowStream stream(options.data, TargetRows::columns(), options.output, outcome);
  stream.run(
      [&](Table table, const show::PassThrough& columns) {
        return rows.compute(std::move(table), columns);
      },
      outcome);
  const TargetTotals& found = rows.found();
  const auto all = found.counts.rows(), refused = found.counts.refused_rows();
  outcome.result = {{"rows", all},
                    {"corrected", corrected_rows(found)},
                    {"refused", refused},
                    {"refused_by", refused_json(found.counts)},
                    {"status", to_json(found.counts)},
                    {"limited", found.limited},
                    {"largest_mm", show::to_mm(found.largest_m)},
                    {"largest_rotation_deg", show::to_deg(found.largest_rad)}};
  put_mistake(found, outcome.result);
  judge(found, outcome);
  if (outcome.exit == Exit::kDone) stream.deliver(summary(found, model), outcome);
}

}  // namespace

void add_correct(Program& program) {
  const auto options = std::make_shared<CorrectArguments>();
  VerbOptions verb = program.verb(
      {.name = "correct",
       .summary = "What to command so that the true arm reaches a target",
       .examples = "  plumb correct robot.plumb --data targets.csv -o corrected.csv\n"
                   "  plumb correct robot.plumb --data path.csv --start 0,-90,90,0,90,0 -o out.csv",
       .in_cell = false},
      [options](const Globals& g, Outcome& o) { correct(*options, g, o); });
  verb.add_option("MODEL", options->model, "Model file of plumb compile").required();
  verb.add_option("--data", options->data,
                  "CSV file: x_mm,y_mm,z_mm,qw,qx,qy,qz in the base frame and the joint state "
                  "q1_deg ... (or commanded, qc1_deg ...)")
      .required()
      .type_name("FILE");
  verb.add_option("--start", options->start,
                  "Joints before the first target [deg, mm], if the file has no joint columns")
      .type_name("Q1,Q2,...");
  options->output.add_to(verb);
}

}  // namespace plumb::offline::cli

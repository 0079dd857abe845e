// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/corrected.hpp"
#include "cli/csv_output.hpp"
#include "cli/model_file.hpp"
#include "cli/verbs.hpp"
#include "fit/effect_binding.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

struct Options {
  std::string model, data;
  std::vector<double> start;  // deg or mm
  CsvOutput output;
};

constexpr std::size_t kMostJointsWithoutCommand = 6;

std::vector<bool> joint_is_angle(const format::Chain& chain) {
  std::vector<bool> out;
  for (const auto& row : chain.joints) out.push_back(!show::slides(row));
  return out;
}

Targets open_targets(const Options& options, const format::Chain& chain, Outcome& outcome) {
  Targets targets = read_targets(options.data, joint_is_angle(chain));
  outcome.inputs.push_back({targets.table.file, targets.table.sha256});
  outcome.remark(targets.table.remarks);
  return targets;
}

/// --start in SI.
std::vector<double> start_of(const Options& options, const format::Chain& chain) {
  if (options.start.empty()) return {};
  if (options.start.size() != chain.joints.size())
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = fmt::format("--start has {} numbers, the arm {} joints",
                                          options.start.size(), chain.joints.size()),
                   .help = "give one number a joint, deg or mm, with commas between"});
  std::vector<double> out;
  for (std::size_t i = 0; i < options.start.size(); ++i)
    out.push_back(show::slides(chain.joints[i]) ? options.start[i] * 1e-3
                                                : show::from_deg(options.start[i]));
  return out;
}

void check_seeds(const Targets& targets, const format::Chain& chain,
                 const std::vector<double>& start) {
  const Place place{.file = targets.table.file, .line = targets.table.lines.front()};
  if (chain.joints.size() > kMostJointsWithoutCommand && !targets.commanded)
    throw Failure(Exit::kInput,
                  {.code = "E-TARGET-COMMANDED",
                   .message = "an arm of more than six joints needs the commanded joints",
                   .place = place,
                   .help = "add columns qc1_deg ... to the targets"});
  if (targets.seed.rows() == 0 && start.empty())
    throw Failure(Exit::kInput, {.code = "E-TARGET-SEED",
                                 .message = "the first target has no joint state to start from",
                                 .place = place,
                                 .help = "add columns q1_deg ..., or: --start 0,-90,90,0,90,0"});
}

void set_commands(const std::vector<format::Pose>& poses, show::CsvColumns& columns) {
  const auto set = [&](const char* name, const auto& value) {
    std::vector<double> values;
    for (const auto& pose : poses) values.push_back(value(pose));
    columns.set(name, values);
  };
  set("cx_mm", [](const auto& pose) { return show::to_mm(pose.p[0]); });
  set("cy_mm", [](const auto& pose) { return show::to_mm(pose.p[1]); });
  set("cz_mm", [](const auto& pose) { return show::to_mm(pose.p[2]); });
  set("cqw", [](const auto& pose) { return pose.q[0]; });
  set("cqx", [](const auto& pose) { return pose.q[1]; });
  set("cqy", [](const auto& pose) { return pose.q[2]; });
  set("cqz", [](const auto& pose) { return pose.q[3]; });
}

void remark_on(const Targets& targets, const Corrected& corrected, Outcome& outcome) {
  if (targets.quat_B.rows() == 0)
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-TARGET-ORIENTATION",
         .message = "the targets have no quaternion: the nominal orientation at each seed is meant",
         .help = "to say it yourself add columns qw, qx, qy, qz"});
  const auto count = std::count_if(corrected.status.begin(), corrected.status.end(), refused);
  if (count > 0)
    outcome.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-CORRECT-REFUSED",
         .message = fmt::format("{} of {} targets were refused; their command is the target itself",
                                count, corrected.status.size()),
         .help = "see the column status, and: plumb explain near-singular"});
}

std::string summary(const Corrected& c) {
  return fmt::format("Corrected {} targets; the largest correction is {} mm and {:.4f} deg.\n{}",
                     c.status.size(), show::mm(c.largest_m), show::to_deg(c.largest_rad),
                     status_summary(c.status));
}

void correct(const Options& options, const Globals& globals, Outcome& outcome) {
  check_output(options.output, globals);
  const format::Model model = open_model(options.model, outcome);
  const Targets targets = open_targets(options, model.nominal, outcome);
  const auto start = start_of(options, model.nominal);
  check_seeds(targets, model.nominal, start);
  const Corrected corrected =
      correct_targets(Corrector(model), targets, start, temperature_names(model));
  show::CsvColumns columns({targets.table});
  set_commands(corrected.command, columns);
  columns.set("status", status_texts(corrected.status));
  remark_on(targets, corrected, outcome);
  outcome.result = {{"rows", corrected.status.size()},
                    {"status", status_counts(corrected.status)},
                    {"largest_correction_mm", show::to_mm(corrected.largest_m)},
                    {"largest_rotation_deg", show::to_deg(corrected.largest_rad)}};
  deliver(columns, options.output, summary(corrected), outcome);
}

}  // namespace

void add_correct(Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App& verb = program.verb(
      {.name = "correct",
       .summary = "What to command so that the true arm reaches a target",
       .examples =
           "  plumb correct robot.plumb --data targets.csv -o corrected.csv\n"
           "  plumb correct robot.plumb --data path.csv --start 0,-90,90,0,90,0 -o out.csv"},
      [options](const Globals& g, Outcome& o) { correct(*options, g, o); });
  verb.add_option("MODEL", options->model, "Model file of plumb compile")->required();
  verb.add_option("--data", options->data,
                  "CSV file: x_mm,y_mm,z_mm,qw,qx,qy,qz in the base frame and the joint state "
                  "q1_deg ... (or commanded, qc1_deg ...)")
      ->required()
      ->type_name("FILE");
  verb.add_option("--start", options->start,
                  "Joints before the first target [deg, mm], if the file has no joint columns")
      ->delimiter(',')
      ->type_name("Q1,Q2,...");
  options->output.add_to(verb);
}

}  // namespace plumb::offline::cli

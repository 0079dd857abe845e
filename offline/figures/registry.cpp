// SPDX-License-Identifier: Apache-2.0
#include "figures/registry.hpp"

#include <algorithm>
#include <functional>

#include "figures/data_figures.hpp"
#include "figures/error_figures.hpp"
#include "figures/formula_law.hpp"
#include "figures/joint_residual.hpp"
#include "figures/law_figures.hpp"
#include "figures/model_figures.hpp"
#include "figures/run_figures.hpp"

namespace plumb::offline::figures {
namespace {

constexpr const char* kEveryJoint = "JN";

/// All that a figure may be drawn from.
struct Sources {
  const RunResults& results;
  const std::vector<Run>& earlier;
  int joint = 0;
};

using Drawing = std::function<std::string(const Sources&, double width)>;

struct Entry {
  FigureRow row;
  Drawing draw;
};

Drawing of_run(std::string (*figure)(const RunResults&, double)) {
  return [figure](const Sources& from, double width) { return figure(from.results, width); };
}

Drawing of_context(Quantity quantity) {
  return [quantity](const Sources& from, double width) {
    return context_figure(from.results, quantity, width);
  };
}

std::string waterfall_of(const Sources& from, double width) {
  return waterfall(from.results, waterfall_steps(from.results, from.earlier), width);
}

/// A figure of one joint; of one that stands still in these poses, with no poses.
Drawing of_joint(std::string (*figure)(const RunResults&, const JointResidual&, double)) {
  return [figure](const Sources& from, double width) {
    const auto& [results, earlier, joint] = from;
    for (const auto& one : joint_residuals(results))
      if (one.joint == joint) return figure(results, one, width);
    const auto& row = results.cell.nominal.joints[static_cast<std::size_t>(joint)];
    return figure(
        results,
        {.joint = joint, .name = row.name, .turns = row.type != format::JointType::kPrismatic},
        width);
  };
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{"error-hist", "How many poses miss by how much, before and after"}, of_run(error_hist)},
      {{"error-ecdf", "Share of the poses that miss by no more than an error"}, of_run(error_ecdf)},
      {{"error-by-pose", "Every pose, sorted by its error, the worst ones named"},
       of_run(error_by_pose)},
      {{"error-map", "Error arrows over the workspace, from above, the side and the front"},
       of_run(error_map)},
      {{"orientations", "How far measured orientations are missed, over each joint"},
       of_run(orientations_figure)},
      {{"joints", "What is left as a deviation of each joint, over its own position"},
       of_run(joints_figure)},
      {{"joint-JN", "The same of one joint, large, with the law that was fitted to it"},
       of_joint(joint_figure)},
      {{"spectrum-JN", "Which waves a turn, or a metre, the deviation of a joint has"},
       of_joint(spectrum_figure)},
      {{"load-JN", "Deviation of a joint over the load on it, with the fitted spring"},
       of_joint(load_figure)},
      {{"formulas", "Each formula of your own over what it follows, with what it has to explain"},
       of_run(formulas_figure)},
      {{"evidence", "Which effect is missing, with the evidence for each (runs plumb diagnose)",
        FigureRow::Needs::kDiagnosis},
       {}},
      {{"waterfall", "Held-out error as effects are added, over the runs of these data",
        FigureRow::Needs::kEarlierRuns},
       waterfall_of},
      {{"history", "Mean error at every recheck, with its control limit"}, of_run(history_figure)},
      {{"poses", "How many poses it takes, alone and with what other runs taught (fits 60 times)",
        FigureRow::Needs::kFits},
       {}},
      {{"order", "What is left in the order of measuring, with jumps and drifts"},
       of_run(order_figure)},
      {{"context-temperature", "What is left over each temperature that was measured"},
       of_context(Quantity::kTemperature)},
      {{"context-payload", "What is left over the payload"}, of_context(Quantity::kPayload)},
      {{"context-time", "What is left over the time"}, of_context(Quantity::kTime)},
      {{"parameters", "What calibration changed, with 95 % intervals and the usual range of arms"},
       of_run(parameters_figure)},
      {{"regions", "Mean error by joint position and region of the workspace, with counts"},
       of_run(regions_figure)},
      {{"coverage", "Which part of its range each joint used, held-out poses marked"},
       of_run(coverage_figure)},
      {{"correlation", "Which fitted numbers can hardly be told apart"},
       of_run(correlation_figure)},
      {{"uncertainty", "How sure the corrected point is over the workspace, 1 sigma"},
       of_run(uncertainty_figure)},
      {{"observability", "What the next poses would tell, well chosen and at random",
        FigureRow::Needs::kPlan},
       {}},
      {{"leaf-map", "What the trees correct, and where their leaves end"}, of_run(leaf_map_figure)},
      {{"refusals", "Where the inverse correction refuses, and why, over workspace and joints"},
       of_run(refusals_figure)},
      {{"latency", "How long a cycle of the compiled run takes here (runs plumb bench)",
        FigureRow::Needs::kBench},
       {}},
      {{"cost", "What each effect and the trees cost in a cycle (runs plumb bench)",
        FigureRow::Needs::kBench},
       {}}};
  return all;
}

std::string with_joint(std::string name, const std::string& joint) {
  const auto at = name.find(kEveryJoint);
  return at == std::string::npos ? name : name.replace(at, 2, joint);
}

bool for_each_joint(const Entry& entry) {
  return entry.row.name.find(kEveryJoint) != std::string::npos;
}

}  // namespace

const std::vector<FigureRow>& figure_list() {
  static const std::vector<FigureRow> rows = [] {
    std::vector<FigureRow> out;
    for (const Entry& entry : entries()) out.push_back(entry.row);
    return out;
  }();
  return rows;
}

std::vector<CellFigure> figures_of(const Cell& cell) {
  std::vector<CellFigure> out;
  for (const Entry& entry : entries()) {
    if (!for_each_joint(entry)) {
      out.push_back({entry.row.name, entry.row.shows});
      continue;
    }
    for (const auto& row : cell.nominal.joints)
      out.push_back({with_joint(entry.row.name, row.name), entry.row.shows});
  }
  return out;
}

std::vector<std::string> figure_names(const Cell& cell) {
  std::vector<std::string> out;
  for (auto& figure : figures_of(cell)) out.push_back(std::move(figure.name));
  return out;
}

std::string why_empty(const std::string& name, const RunResults& results) {
  const auto unless = [](bool shows, const char* why) { return std::string(shows ? "" : why); };
  if (name == "context-temperature")
    return unless(context_varies(results, Quantity::kTemperature),
                  "no temperature was measured, or it never changed");
  if (name == "context-payload")
    return unless(context_varies(results, Quantity::kPayload), "the payload never changed");
  if (name == "context-time")
    return unless(context_varies(results, Quantity::kTime), "no time was recorded");
  if (name == "orientations")
    return unless(results.run.fit.turned_G.size() > 0, "no measured orientations were fitted");
  if (name == "history") return unless(!results.rechecks.empty(), "the run was never rechecked");
  if (name == "formulas") return unless(has_formula(results), "the model has no formula");
  if (name == "leaf-map") {
    const auto& trees = results.run.fit.calibration.state.arm.trees;
    return unless(
        std::any_of(trees.begin(), trees.end(), [](const auto& tree) { return tree.leaves() > 0; }),
        "the model has no tree");
  }
  if (name.starts_with("load-"))
    for (const auto& joint : joint_residuals(results))
      if (name == "load-" + joint.name)
        return unless(load_varies(results, joint), "the load on the joint hardly changes");
  return "";
}

FigureRow::Needs needs_of(const std::string& name) {
  for (const Entry& entry : entries())
    if (entry.row.name == name) return entry.row.needs;
  return FigureRow::Needs::kRun;
}

std::optional<std::string> drawn(const std::string& name, const RunResults& results, double width,
                                 const std::vector<Run>& earlier) {
  const auto& joints = results.cell.nominal.joints;
  for (const Entry& entry : entries()) {
    if (!entry.draw) continue;  // of no run
    if (entry.row.name == name && !for_each_joint(entry))
      return entry.draw({results, earlier}, width);
    if (!for_each_joint(entry)) continue;
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (with_joint(entry.row.name, joints[j].name) == name)
        return entry.draw({results, earlier, static_cast<int>(j)}, width);
  }
  return std::nullopt;
}

}  // namespace plumb::offline::figures

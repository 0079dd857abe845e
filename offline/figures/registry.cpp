// SPDX-License-Identifier: Apache-2.0
#include "figures/registry.hpp"

#include <functional>

#include "figures/data_figures.hpp"
#include "figures/error_figures.hpp"
#include "figures/joint_residual.hpp"
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

std::string waterfall_of(const Sources& from, double width) {
  return waterfall(from.results, waterfall_steps(from.results, from.earlier), width);
}

std::string joint_of(const Sources& from, double width) {
  const auto& [results, earlier, joint] = from;
  for (const auto& one : joint_residuals(results))
    if (one.joint == joint) return joint_figure(results, one, width);
  JointResidual still{.joint = joint,
                      .name = results.cell.nominal.joints[static_cast<std::size_t>(joint)].name};
  return joint_figure(results, still, width);
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{"error-hist", "How many poses miss by how much, before and after"}, of_run(error_hist)},
      {{"error-ecdf", "Share of the poses that miss by no more than an error"}, of_run(error_ecdf)},
      {{"error-by-pose", "Every pose, sorted by its error, the worst ones named"},
       of_run(error_by_pose)},
      {{"error-map", "Error arrows over the workspace, from above, the side and the front"},
       of_run(error_map)},
      {{"joints", "What is left as a deviation of each joint, over its own position"},
       of_run(joints_figure)},
      {{"joint-JN", "The same of one joint, large"}, joint_of},
      {{"evidence", "Which effect is missing, with the evidence for each (runs plumb diagnose)",
        FigureRow::Needs::kDiagnosis},
       {}},
      {{"waterfall", "Held-out error as effects are added, over the runs of these data",
        FigureRow::Needs::kEarlierRuns},
       waterfall_of},
      {{"order", "What is left in the order of measuring, with jumps and drifts"},
       of_run(order_figure)},
      {{"parameters", "What calibration changed, with 95 % intervals and the usual range of arms"},
       of_run(parameters_figure)},
      {{"regions", "Mean error by joint position and region of the workspace, with counts"},
       of_run(regions_figure)},
      {{"coverage", "Which part of its range each joint used, held-out poses marked"},
       of_run(coverage_figure)},
      {{"correlation", "Which fitted numbers can hardly be told apart"},
       of_run(correlation_figure)}};
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

std::vector<std::string> figure_names(const Cell& cell) {
  std::vector<std::string> out;
  for (const Entry& entry : entries()) {
    if (!for_each_joint(entry)) {
      out.push_back(entry.row.name);
      continue;
    }
    for (const auto& row : cell.nominal.joints) out.push_back(with_joint(entry.row.name, row.name));
  }
  return out;
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

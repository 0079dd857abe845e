// SPDX-License-Identifier: Apache-2.0
#include "figures/registry.hpp"

#include <functional>

#include "figures/error_figures.hpp"
#include "figures/joint_residual.hpp"

namespace plumb::offline::figures {
namespace {

constexpr const char* kEveryJoint = "JN";

using Drawing = std::function<std::string(const RunResults&, int joint, double width)>;

struct Entry {
  FigureRow row;
  Drawing draw;
};

Drawing of_run(std::string (*figure)(const RunResults&, double)) {
  return [figure](const RunResults& results, int, double width) { return figure(results, width); };
}

std::string joint_of(const RunResults& results, int joint, double width) {
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
      {{"joint-JN", "The same of one joint, large"}, joint_of}};
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

std::optional<std::string> drawn(const std::string& name, const RunResults& results, double width) {
  for (const Entry& entry : entries()) {
    if (!for_each_joint(entry)) {
      if (entry.row.name == name) return entry.draw(results, 0, width);
      continue;
    }
    for (int j = 0; j < results.cell.joints(); ++j)
      if (with_joint(entry.row.name,
                     results.cell.nominal.joints[static_cast<std::size_t>(j)].name) == name)
        return entry.draw(results, j, width);
  }
  return std::nullopt;
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "figures/heat_map.hpp"
#include "figures/model_figures.hpp"
#include "figures/words.hpp"
#include "plumb/runtime/detail/tree.hpp"

namespace plumb::offline::figures {
namespace {

constexpr int kGrid = 48;  // cells of the map each way
constexpr std::size_t kMostMapPoses = 250;
constexpr std::array<const char*, 3> kTreeAxis{"x", "y", "z"};

std::size_t leaves_of(const format::Model& arm) {
  std::size_t out = 0;
  for (const auto& tree : arm.trees) out += tree.leaves();
  return out;
}

/// How often the trees ask for each input; where they are equal, the later joint comes behind.
std::vector<double> uses_of(const format::Model& arm, std::size_t inputs) {
  std::vector<double> out(inputs, 0.0);
  for (const auto& tree : arm.trees) {
    for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
      if (tree.directions.size() == tree.nodes.size() * inputs)
        for (std::size_t i = 0; i < inputs; ++i)
          out[i] += std::abs(tree.directions[k * inputs + i]);
      else if (tree.nodes[k].input < inputs)
        out[tree.nodes[k].input] += 1.0;
    }
    // A tree of one leaf: by the slopes of the leaf, which weigh next to nothing beside a split.
    const std::size_t terms = format::leaf_terms(inputs, tree.degree);
    for (std::size_t k = 0; k + terms <= tree.coefficients.size(); k += terms)
      for (std::size_t i = 0; i < inputs; ++i)
        out[i] += 1e-6 * std::abs(tree.coefficients[k + 1 + i]);
  }
  return out;
}

struct Inputs {
  std::size_t across = 0, up = 1;
};

Inputs most_used(const std::vector<double>& uses) {
  std::vector<std::size_t> order(uses.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return uses[a] > uses[b]; });
  return {order[0], order[1]};
}

double per(const format::JointRow& row) {
  return row.type == format::JointType::kPrismatic ? 1e3 : 180.0 / std::numbers::pi;
}

std::string title_of(const format::JointRow& row) {
  return fmt::format("position of {} [{}]", row.name,
                     row.type == format::JointType::kPrismatic ? "mm" : "deg");
}

/// A cut through the tree of one axis.
HeatMap map_of(const RunResults& results, const format::Tree& tree, const Inputs& inputs,
               double per_m) {
  const format::Model& arm = results.run.fit.calibration.state.arm;
  const auto n = results.cell.nominal.joints.size();
  const auto& x = results.cell.nominal.joints[inputs.across];
  const auto& y = results.cell.nominal.joints[inputs.up];
  HeatMap out{.x_title = title_of(x),
              .y_title = title_of(y),
              .x_low = per(x) * arm.domain.q_min[inputs.across],
              .x_high = per(x) * arm.domain.q_max[inputs.across],
              .y_low = per(y) * arm.domain.q_min[inputs.up],
              .y_high = per(y) * arm.domain.q_max[inputs.up],
              .value = Eigen::MatrixXd::Zero(kGrid, kGrid),
              .scale = ColourScale::kSigned,
              .lines = {}};
  if (tree.leaves() == 0) return out;
  const TreeView view(tree, static_cast<int>(n));
  Eigen::MatrixXi leaf(kGrid, kGrid);
  std::vector<double> u(n, 0.0);
  for (int r = 0; r < kGrid; ++r)
    for (int c = 0; c < kGrid; ++c) {
      u[inputs.across] = (2.0 * c + 1.0) / kGrid - 1.0;
      u[inputs.up] = (2.0 * r + 1.0) / kGrid - 1.0;
      out.value(r, c) = per_m * view.evaluate(u);
      leaf(r, c) = view.leaf(u);
    }
  const double dx = (out.x_high - out.x_low) / kGrid, dy = (out.y_high - out.y_low) / kGrid;
  for (int r = 0; r < kGrid; ++r)
    for (int c = 0; c < kGrid; ++c) {
      const double left = out.x_low + dx * c, low = out.y_low + dy * r;
      if (c > 0 && leaf(r, c) != leaf(r, c - 1)) out.lines.push_back({left, low, left, low + dy});
      if (r > 0 && leaf(r, c) != leaf(r - 1, c)) out.lines.push_back({left, low, left + dx, low});
    }
  return out;
}

void draw_poses(const RunResults& results, const Inputs& inputs, const std::vector<int>& rows,
                draw::Svg& svg, draw::Panel& panel) {
  const auto& joints = results.cell.nominal.joints;
  svg.clip(panel.plot());
  for (const int row : rows) {
    const bool held = std::binary_search(results.held.begin(), results.held.end(), row);
    panel.mark(
        per(joints[inputs.across]) *
            results.measured.q(row, static_cast<Eigen::Index>(inputs.across)),
        per(joints[inputs.up]) * results.measured.q(row, static_cast<Eigen::Index>(inputs.up)),
        {.paint = draw::Tone::kInk,
         .fill = held ? draw::Mark::Fill::kFilled : draw::Mark::Fill::kHollow,
         .size = 1.8,
         .pose = results.pose(row),
         .words = pose_numbers(results, row)});
  }
  svg.end_clip();
}

std::string no_tree(const RunResults& results, double width) {
  const auto& choice = results.run.fit.tree;
  std::string why =
      "The model of this run has no tree: the effects and the geometry are all of it.";
  if (choice && !choice->reason.empty()) why = "A tree was tried and not taken: " + choice->reason;
  draw::Sheet sheet(
      width, {.title = "What the trees correct, and where",
              .sentence = why,
              .notes = {fmt::format("Run {}. A tree is tried if cell.toml lists local_tree under "
                                    "[effects].",
                                    results.run.number)}});
  return sheet.file();
}

}  // namespace

std::string leaf_map_figure(const RunResults& results, double width) {
  const format::Model& arm = results.run.fit.calibration.state.arm;
  const std::size_t n = results.cell.nominal.joints.size();
  if (leaves_of(arm) == 0 || n < 2 || arm.domain.q_min.size() != n || arm.domain.q_max.size() != n)
    return no_tree(results, width);
  const auto uses = uses_of(arm, n);
  const Inputs inputs = most_used(uses);
  double most_m = 0.0, splits = 0.0;
  std::vector<HeatMap> maps;
  std::vector<std::size_t> axes;  // that have a tree
  std::string leaves;
  for (std::size_t k = 0; k < arm.trees.size(); ++k) {
    const auto& tree = arm.trees[k];
    if (tree.leaves() == 0) continue;
    axes.push_back(k);
    maps.push_back(map_of(results, tree, inputs, 1.0));
    most_m = std::max(most_m, maps.back().value.cwiseAbs().maxCoeff());
    splits += static_cast<double>(tree.nodes.size());
    leaves += fmt::format("{}{} for {}", leaves.empty() ? "" : ", ", tree.leaves(), kTreeAxis[k]);
  }
  const LengthUnit unit = unit_for(most_m);
  const auto& names = results.cell.nominal.joints;
  std::string sentence = fmt::format("Leaves of the trees: {}; they correct up to {} in this cut",
                                     leaves, length_text(most_m));
  if (splits > 0.0)
    sentence += fmt::format(", and {:.0f} % of their splits are by {} and {}",
                            100.0 * std::min(1.0, (uses[inputs.across] + uses[inputs.up]) / splits),
                            names[inputs.across].name, names[inputs.up].name);
  sentence += ".";
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  std::sort(rows.begin(), rows.end());
  const auto shown = thinned(results, rows, kMostMapPoses);
  std::vector<std::string> notes{fmt::format(
      "Run {}: value of the trees along the axes of the base, with the other joints in the middle "
      "of "
      "the trained range; lines: where one leaf ends. Filled: held-out poses, hollow: fitted ones, "
      "wherever their other joints were.",
      results.run.number)};
  if (const auto note = thinning_note(shown.size(), rows.size()); !note.empty())
    notes.push_back(note);
  draw::Sheet sheet(width,
                    {.title = "What the trees correct, and where",
                     .sentence = sentence,
                     .legend = colour_legend(ColourScale::kSigned, unit.per_m * most_m, unit.name),
                     .notes = std::move(notes)});
  const auto rooms = sheet.grid(static_cast<int>(axes.size()), 210.0, 330.0);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    maps[k].most = most_m;
    auto panel =
        draw_map(maps[k], sheet.svg(), rooms[k],
                 fmt::format("along {}: {} {}", kTreeAxis[axes[k]], arm.trees[axes[k]].leaves(),
                             arm.trees[axes[k]].leaves() == 1 ? "leaf" : "leaves"));
    draw_poses(results, inputs, shown, sheet.svg(), panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#include "figures/study_figures.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "draw/ticks.hpp"
#include "figures/heat_map.hpp"

namespace plumb::offline::figures {
namespace {

using study::AxisTrees;
using study::PlanarStudy;
using study::StudyRow;

constexpr const char* kAxisName[] = {"x", "y"};
constexpr double kWidth = 720.0;  // [px]

double to_deg(double radians) { return radians * 180.0 / std::numbers::pi; }

/// A map with the words around it.
struct StudyMap {
  HeatMap map;
  std::string title, sentence;

  std::string file() const {
    return map_file(
        map,
        {.title = title,
         .sentence = sentence,
         .notes = {"Planar study, test grid; phi12 and phi23 are the joint positions."}},
        "mm", kWidth);
  }
};

/// One quantity on the test grid: a row for each phi12, a column for each phi23.
HeatMap grid_of(const PlanarStudy& study, const Eigen::VectorXd& value_mm) {
  const RowsN& q = study.test_q;
  Eigen::Index columns = 0;
  while (columns < q.rows() && q(columns, 0) == q(0, 0)) ++columns;
  HeatMap out;
  out.value.resize(q.rows() / columns, columns);
  for (Eigen::Index i = 0; i < q.rows(); ++i) out.value(i / columns, i % columns) = value_mm[i];
  out.x_low = to_deg(q.col(1).minCoeff());
  out.x_high = to_deg(q.col(1).maxCoeff());
  out.y_low = to_deg(q.col(0).minCoeff());
  out.y_high = to_deg(q.col(0).maxCoeff());
  out.x_title = "phi23 [deg]";
  out.y_title = "phi12 [deg]";
  return out;
}

/// Borders of the leaves of a tree split along the axes.
class Borders {
 public:
  Borders(const AxisTrees& trees, int axis) : tree_(trees.tree[axis]), domain_(trees.domain) {
    if (!tree_.nodes.empty()) visit(0, {-1.0, -1.0}, {1.0, 1.0});
  }
  std::vector<MapLine> lines;

 private:
  using Corner = std::array<double, 2>;

  double deg(int input, double u) const {
    const double mid = 0.5 * (domain_.q_min[input] + domain_.q_max[input]);
    return to_deg(mid + 0.5 * u * (domain_.q_max[input] - domain_.q_min[input]));
  }

  void visit(int node, Corner low, Corner high) {
    if (node < 0) return;
    const auto& n = tree_.nodes[static_cast<std::size_t>(node)];
    const double at = deg(n.input, n.threshold);
    if (n.input == 0)
      lines.push_back({deg(1, low[1]), at, deg(1, high[1]), at});
    else
      lines.push_back({at, deg(0, low[0]), at, deg(0, high[0])});
    Corner middle = high;
    middle[n.input] = n.threshold;
    visit(n.low, low, middle);
    middle = low;
    middle[n.input] = n.threshold;
    visit(n.high, middle, high);
  }

  const format::Tree& tree_;
  const format::Domain& domain_;
};

/// Error of the calibrated arm along one axis at the test grid [mm].
Eigen::VectorXd remaining_mm(const PlanarStudy& study, int axis) {
  const auto truth = study::true_poses(study.request.variant, study.test_q);
  return 1e3 * (truth.p_AC_A - study::rigid_points(study.links.d, study.test_q)).col(axis);
}

StudyMap signed_map(const PlanarStudy& study, const Eigen::VectorXd& value, std::string title) {
  StudyMap out{grid_of(study, value), std::move(title), ""};
  out.map.scale = ColourScale::kSigned;
  out.map.most = value.cwiseAbs().maxCoeff();
  out.sentence = fmt::format("It runs from {} to {} mm.", draw::digits(value.minCoeff(), 3),
                             draw::digits(value.maxCoeff(), 3));
  return out;
}

StudyMap leaf_map(const StudyRow& row, int axis, StudyMap below) {
  below.map.lines = Borders(*row.trees, axis).lines;
  below.sentence =
      fmt::format("The tree has {} leaves for {}, small where what it learns bends most.",
                  row.trees->tree[axis].leaves(), kAxisName[axis]);
  below.title = fmt::format("{}: leaves over the {}", row.model, below.title);
  return below;
}

StudyMap total_map(const PlanarStudy& study, const StudyRow& row) {
  StudyMap out{grid_of(study, 1e3 * row.error_at_test), row.model + ": total error", ""};
  out.sentence =
      fmt::format("The mean is {} mm, the largest {} mm.", draw::digits(1e3 * row.test.mean, 3),
                  draw::digits(1e3 * row.test.max, 3));
  out.map.most = 1e3 * row.test.max;
  return out;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> planar_figures(const PlanarStudy& study) {
  std::vector<std::pair<std::string, std::string>> out;
  const auto positions = study::true_poses(study.request.variant, study.test_q).p_AC_A;
  for (int axis = 0; axis < 2; ++axis) {
    const StudyMap error =
        signed_map(study, remaining_mm(study, axis),
                   fmt::format("error of the calibrated arm, {}", kAxisName[axis]));
    out.emplace_back(fmt::format("fig{:02}_error_{}.svg", 4 + axis, kAxisName[axis]), error.file());
    const StudyMap leaves = leaf_map(study.row("calibrated_llmt"), axis, error);
    out.emplace_back(fmt::format("fig{:02}_leaves_{}.svg", 6 + axis, kAxisName[axis]),
                     leaves.file());
    const StudyMap place =
        signed_map(study, 1e3 * positions.col(axis), fmt::format("position {}", kAxisName[axis]));
    const StudyMap alone = leaf_map(study.row("alone"), axis, place);
    out.emplace_back(fmt::format("fig{:02}_leaves_alone_{}.svg", 8 + axis, kAxisName[axis]),
                     alone.file());
  }
  for (const StudyRow& row : study.rows)
    out.emplace_back(fmt::format("fig10_{}.svg", row.key), total_map(study, row).file());
  return out;
}

}  // namespace plumb::offline::figures

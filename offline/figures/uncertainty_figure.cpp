// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "arm/effect_binding.hpp"
#include "arm/geometry_derivative.hpp"
#include "arm/predicted_points.hpp"
#include "cell/random.hpp"
#include "compile/compiler.hpp"
#include "figures/model_figures.hpp"
#include "figures/words.hpp"
#include "figures/workspace_views.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr int kSpread = 1200;               // random poses within the joint limits
constexpr std::size_t kMostMeasured = 300;  // of the measured ones
constexpr double kCell_px = 11.0, kCellMargin_px = 12.0;
constexpr int kShades = 48;    // of the colour scale
constexpr double kTop = 0.98;  // quantile of the cells that is the end of the colour scale

struct Point {
  Eigen::Vector3d p_B;
  double sigma_m = 0.0;
  int row = -1;  // of the measurements; -1: not measured
};

/// sigma at a joint position, by the numbers of the arm: the placement of the tracker and the
/// reflector are not part of the model.
class Predictor {
 public:
  explicit Predictor(const RunResults& results) : state_(results.run.fit.calibration.state) {
    const Calibration& c = results.run.fit.calibration;
    const auto fitted = fitted_parameters(results.run);
    const auto& effects = state_.arm.effects;
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      if (!fitted[i]) continue;
      // What moved while the poses were measured is cleaned out of the model, and is no part of it.
      if (fitted[i]->of_effect() &&
          !runs_online(effects[static_cast<std::size_t>(fitted[i]->joint)]))
        continue;
      columns_.push_back(static_cast<Eigen::Index>(i));
      parameters_.push_back(*fitted[i]);
    }
    covariance_ = c.covariance(columns_, columns_);
    const auto count = static_cast<Eigen::Index>(parameters_.size());
    geometry_.emplace(state_, parameters_, Eigen::VectorXd::Zero(count));
    X_BM_ = from_pose(state_.X_MB).inverse();
    for (int k = 0; k < 3; ++k)
      if (results.measured.has_axis[static_cast<std::size_t>(k)]) axes_.push_back(k);
  }

  bool empty() const { return parameters_.empty(); }
  std::string axes_words() const {
    static constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
    if (axes_.size() == 3) return "three axes together";
    std::string out;
    for (const int k : axes_) out += (out.empty() ? "" : " and ") + std::string(kNames.at(k));
    return out + (axes_.size() > 1 ? " together, the axes that were measured"
                                   : ", the axis that was measured");
  }
  std::size_t numbers() const { return parameters_.size(); }
  const std::vector<std::string>& sensors() const { return geometry_->sensors(); }

  Point at(std::span<const double> q, const MeasuredContext& context) {
    geometry_->evaluate(q, context, point_);
    const Eigen::MatrixXd J = point_.columns(axes_, Eigen::all);
    return {X_BM_ * point_.p_M, std::sqrt(std::max(0.0, (J * covariance_).cwiseProduct(J).sum())),
            -1};
  }

 private:
  const ArmState& state_;
  std::vector<Eigen::Index> columns_;
  std::vector<Parameter> parameters_;
  Eigen::MatrixXd covariance_;
  std::optional<GeometryDerivative> geometry_;
  GeometryDerivative::Point point_;
  Transformd X_BM_;
  std::vector<int>
      axes_;  // of the measurement frame that were measured: nothing is known of others
};

std::vector<Point> measured_points(const RunResults& results, Predictor& predict) {
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  std::sort(rows.begin(), rows.end());
  std::vector<Point> out;
  const auto& q = results.measured.q;
  const Transformd X_MB = from_pose(results.run.fit.calibration.state.X_MB);
  for (const int row : thinned(results, rows, kMostMeasured)) {
    out.push_back(predict.at({q.row(row).data(), static_cast<std::size_t>(q.cols())},
                             context_of(results.measured, row, predict.sensors(), X_MB)));
    out.back().row = row;
  }
  return out;
}

std::vector<Point> spread_points(const RunResults& results, Predictor& predict) {
  std::vector<Point> out;
  Random random(1);
  const MeasuredContext nothing;
  std::vector<double> q(static_cast<std::size_t>(results.cell.joints()));
  for (int i = 0; i < kSpread; ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) {
      const auto& row = results.cell.nominal.joints[j];
      q[j] = row.q_min + random.unit() * (row.q_max - row.q_min);
    }
    out.push_back(predict.at(q, nothing));
  }
  return out;
}

std::vector<double> sigmas_of(const std::vector<Point>& points) {
  std::vector<double> out;
  for (const Point& point : points)
    if (std::isfinite(point.sigma_m)) out.push_back(point.sigma_m);
  std::sort(out.begin(), out.end());
  return out;
}

/// Mean of sigma in the square cells of a view, by column and row.
struct CellMean {
  double sum = 0.0;
  int n = 0;
};
using Cells = std::map<std::pair<int, int>, CellMean>;

Cells cells_of(const std::vector<Point>& points, const View& view, double size_m) {
  Cells out;
  for (const Point& point : points) {
    if (!std::isfinite(point.sigma_m)) continue;
    CellMean& cell = out[{static_cast<int>(std::floor(point.p_B(view.across) / size_m)),
                          static_cast<int>(std::floor(point.p_B(view.up) / size_m))}];
    cell.sum += point.sigma_m;
    ++cell.n;
  }
  return out;
}

std::string uncertainty_sentence(const std::vector<Point>& measured,
                                 const std::vector<Point>& spread) {
  const auto near = sigmas_of(measured), all = sigmas_of(spread);
  if (all.empty())
    return "This run does not know the covariance of its numbers: nothing can be said.";
  const auto worst =
      std::max_element(spread.begin(), spread.end(),
                       [](const Point& a, const Point& b) { return a.sigma_m < b.sigma_m; });
  std::string out = fmt::format(
      "Within the joint limits the fitted numbers leave the point "
      "uncertain by {} in the median, and by up to {} near x {:.0f}, y "
      "{:.0f}, z {:.0f} mm",
      length_text(quantile_of(all, 0.5)), length_text(all.back()), 1e3 * worst->p_B(0) + 0.0,
      1e3 * worst->p_B(1) + 0.0, 1e3 * worst->p_B(2) + 0.0);
  if (near.empty()) return out + ".";
  return out + fmt::format("; at the measured poses by {}.", length_text(quantile_of(near, 0.5)));
}

}  // namespace

std::string uncertainty_figure(const RunResults& results, double width) {
  Predictor predict(results);
  std::vector<Point> spread, measured;
  if (!predict.empty()) {
    spread = spread_points(results, predict);
    measured = measured_points(results, predict);
  }
  Extent extent;
  for (const auto* points : {&spread, &measured})
    for (const Point& point : *points)
      if (point.p_B.allFinite()) extent.add(point.p_B);
  const WorkspaceViews views(width, extent, kCellMargin_px);
  const double size_m = kCell_px / views.px_per_m();
  std::vector<double> means;
  for (const View& view : views.views())
    for (const auto& [place, cell] : cells_of(spread, view, size_m))
      means.push_back(cell.sum / cell.n);
  std::sort(means.begin(), means.end());
  const double most = means.empty() ? 0.0 : quantile_of(means, kTop);
  std::vector<draw::LegendEntry> legend;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    if (most > 0.0)
      legend.push_back({.words = length_text(share * most) + (share == 1.0 ? " and more" : ""),
                        .area = draw::magnitude_colour(share)});
  const draw::Mark dot{.paint = Tone::kVermilion, .size = 1.8};
  if (!measured.empty()) legend.push_back({.words = "measured pose", .mark = dot});
  std::vector<std::string> notes{
      fmt::format("Run {}: 1 sigma of the position, {}, by the covariance of {} of the arm. "
                  "Where tracker and reflector stand is not part of it: fitted together with the "
                  "arm, the two make up for each other, so that a measured error can be smaller. "
                  "Neither is what the model does not describe.",
                  results.run.number, predict.axes_words(),
                  counted_words(static_cast<long long>(predict.numbers()), "number", "numbers")),
      fmt::format("Colours: mean over the poses seen in a cell, {} random poses within the joint "
                  "limits in all; {} of {} measured poses are drawn.",
                  spread.size(), measured.size(), results.held.size() + results.fit.size())};
  draw::Sheet sheet(width, {.title = "How sure the corrected point is over the workspace",
                            .sentence = uncertainty_sentence(measured, spread),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  if (spread.empty()) return sheet.file();
  auto panels = views.panels(sheet);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const View& view = views.views()[k];
    sheet.svg().clip(panels[k].plot());
    std::map<int, std::vector<draw::Box>> colours;  // cells of one shade are one element
    for (const auto& [place, cell] : cells_of(spread, view, size_m)) {
      const double x = 1e3 * size_m * place.first, y = 1e3 * size_m * place.second;
      const double share = most > 0.0 ? std::min(1.0, cell.sum / cell.n / most) : 0.0;
      const draw::Point low = panels[k].at(x, y),
                        high = panels[k].at(x + 1e3 * size_m, y + 1e3 * size_m);
      colours[static_cast<int>(std::lround(share * kShades))].push_back(
          {low.x, high.y, high.x, low.y});
    }
    for (const auto& [shade, boxes] : colours)
      sheet.svg().boxes(boxes, draw::magnitude_colour(static_cast<double>(shade) / kShades));
    for (const Point& point : measured) {
      draw::Mark mark = dot;
      mark.pose = results.pose(point.row);
      mark.words = fmt::format("{}: 1 sigma {}", mark.pose, length_text(point.sigma_m));
      panels[k].mark(1e3 * point.p_B(view.across), 1e3 * point.p_B(view.up), mark);
    }
    sheet.svg().end_clip();
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

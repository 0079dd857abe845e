// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "arm/joint_turns.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/error_figures.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostTurns = 300;   // points in each panel
constexpr std::size_t kTurnSteps = 16;    // of the local means
constexpr std::size_t kFewestOfMean = 4;  // poses
constexpr double kMicro = 1e6;            // millionths in a radian

std::string turn_sentence(const RunResults& results) {
  const Fit& fit = results.run.fit;
  if (fit.turned_G.size() == 0) return "This run fitted no measured orientations.";
  if (fit.turn_held.n == 0) return "No pose was held out: these errors are of fitted orientations.";
  if (!fit.turn_floor.known())
    return fmt::format("Held-out orientations are missed by {} on average.",
                       angle_words(fit.turn_held.mean));
  return fmt::format("Held-out {}.", missed_words(fit.turn_held.mean, fit.turn_floor));
}

/// Means over steps of equally many rows, which are sorted by the joint.
std::vector<draw::Point> turn_means(const std::vector<std::pair<double, double>>& sorted) {
  std::vector<draw::Point> out;
  const std::size_t each = std::max(kFewestOfMean, sorted.size() / kTurnSteps);
  for (std::size_t from = 0; from + each <= sorted.size(); from += each) {
    double x = 0.0, y = 0.0;
    for (std::size_t i = from; i < from + each; ++i) x += sorted[i].first, y += sorted[i].second;
    out.push_back({x / static_cast<double>(each), y / static_cast<double>(each)});
  }
  return out;
}

/// Turns about the axis of one joint [urad] over its position, in [deg] or [mm].
void draw_joint(const RunResults& results, const Eigen::VectorXd& q, const Eigen::VectorXd& turn,
                draw::Panel& panel) {
  std::vector<std::pair<double, double>> sorted;
  for (const int row : results.judged()) sorted.emplace_back(q(row), turn(row));
  std::sort(sorted.begin(), sorted.end());
  panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
  const auto put = [&](const std::vector<int>& rows, Mark::Fill fill) {
    for (const int row : thinned(results, rows, kMostTurns))
      panel.mark(q(row), std::clamp(turn(row), panel.y_low(), panel.y_high()),
                 {.fill = fill,
                  .size = 2.4,
                  .pose = results.pose(row),
                  .words = fmt::format("{}: {:+.0f} µrad", results.pose(row), turn(row))});
  };
  put(results.fit, Mark::Fill::kHollow);
  put(results.held, Mark::Fill::kFilled);
  const auto means = turn_means(sorted);
  panel.line(means, {.paint = Tone::kPaper, .width = 4.0});
  panel.line(means, {.paint = Tone::kInk, .width = 2.0});
}

}  // namespace

std::string orientations_figure(const RunResults& results, double width) {
  const Fit& fit = results.run.fit;
  const bool any = fit.turned_G.size() > 0 && !results.judged().empty();
  auto notes = error_notes(results);
  std::vector<draw::LegendEntry> legend;
  if (any) {
    notes.emplace_back(
        "Drawn is the part of the turn from the predicted to the measured orientation that goes "
        "about the axis of each joint; one scale for all, and points beyond it are at its edge.");
    legend = pose_legend(results);
    legend.push_back({.words = fmt::format("mean over 1/{} of the {}", kTurnSteps,
                                           results.held.empty() ? "poses" : "held-out poses"),
                      .line = draw::LineStyle{Tone::kInk, 2.0}});
  }
  draw::Sheet sheet(
      width, {.title = "What the model leaves of the orientation, about the axis of each joint",
              .sentence = turn_sentence(results),
              .legend = std::move(legend),
              .notes = std::move(notes)});
  if (!any) return sheet.file();
  const RowsN about =
      kMicro * turns_about_joints(fit.calibration.state, results.measured, fit.turned_G);
  std::vector<double> sizes;
  for (const int row : results.judged()) sizes.push_back(about.row(row).cwiseAbs().maxCoeff());
  std::sort(sizes.begin(), sizes.end());
  const double most = std::max(1.0, 1.1 * quantile_of(sizes, 0.99));
  const auto rooms = sheet.grid(results.cell.joints(), 205.0, 250.0);
  for (int j = 0; j < results.cell.joints(); ++j) {
    const auto& row = results.cell.nominal.joints[static_cast<std::size_t>(j)];
    const bool slides = row.type == format::JointType::kPrismatic;
    const Eigen::VectorXd q = (slides ? 1e3 : 180.0 / std::numbers::pi) * results.measured.q.col(j);
    draw::Panel panel(sheet.svg(), rooms[static_cast<std::size_t>(j)],
                      {.title = fmt::format("{} [{}]", row.name, slides ? "mm" : "deg"),
                       .low = q.minCoeff(),
                       .high = q.maxCoeff()},
                      {.title = "turn [µrad]", .low = -most, .high = most});
    draw_joint(results, q, about.col(j), panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

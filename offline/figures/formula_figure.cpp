// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/formula_law.hpp"
#include "figures/joint_residual.hpp"
#include "figures/law_figures.hpp"
#include "figures/words.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr std::size_t kMostFormulaPoints = 400;  // in each panel
constexpr std::size_t kFormulaSteps = 60;        // of a curve of one input
constexpr std::size_t kFewFormulaSteps = 9;      // of a mean over several

const char* unit_of(const FormulaPoints& one) { return one.turns ? "µrad" : "µm"; }

struct FormulaCurve {
  std::vector<draw::Point> middle, low, high;  // the last two: its 95 % interval
};

/// The fitted law as means over steps of equally many poses.
FormulaCurve curve_of(const FormulaPoints& one) {
  FormulaCurve out;
  const std::size_t n = one.poses.size();
  const std::size_t steps = std::min(n, one.inputs > 1 ? kFewFormulaSteps : kFormulaSteps);
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t from = k * n / steps, to = (k + 1) * n / steps;
    double input = 0.0, law = 0.0, sigma = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      const auto& pose = one.poses[i];
      const double share = 1e6 / static_cast<double>(to - from);
      input += 1e-6 * share * pose.input, law += share * pose.law, sigma += share * pose.sigma;
    }
    out.middle.push_back({input, law});
    out.low.push_back({input, law - kNormal95 * sigma});
    out.high.push_back({input, law + kNormal95 * sigma});
  }
  return out;
}

double explained(const FormulaPoints& one) {
  Scatter all, left;
  for (const auto& pose : one.poses) {
    all.add(pose.weight, pose.value);
    left.add(pose.weight, pose.value - pose.law);
  }
  return left.explained_of(all);
}

std::string formulas_sentence(const std::vector<FormulaPoints>& all) {
  if (all.empty()) return "The model has no formula: plumb add formula puts one in.";
  std::string out;
  for (const auto& one : all) {
    double low = INFINITY, high = -INFINITY;
    for (const auto& pose : one.poses)
      low = std::min(low, pose.law), high = std::max(high, pose.law);
    if (!out.empty()) out += " ";
    out += one.poses.empty()
               ? fmt::format("No pose shows what {} does.", one.formula)
               : fmt::format(
                     "{} runs from {} to {} {}, and explains {:.0f} % of the scatter that would be "
                     "there without it.",
                     one.formula, draw::digits(1e6 * low, 2), draw::digits(1e6 * high, 2),
                     unit_of(one), 100.0 * explained(one));
  }
  return out;
}

std::vector<std::string> formulas_notes(const RunResults& results,
                                        const std::vector<FormulaPoints>& all) {
  auto out = error_notes(results);
  if (all.empty()) return out;
  out.emplace_back(
      "Each point: by how much that which the formula moves would have to move to explain the "
      "error "
      "of its pose without the formula; the scatter around the curve is what the model leaves. "
      "Outliers and repeats in a row are left out or averaged.");
  std::size_t most = 0;
  bool several = false;
  for (const auto& one : all)
    most = std::max(most, one.poses.size()), several = several || one.inputs > 1;
  if (several)
    out.emplace_back(
        "Of several inputs of a formula the one is shown that its value follows most; the curve is "
        "then the mean of the formula over equally many poses.");
  if (most > kMostFormulaPoints)
    out.push_back(fmt::format(
        "An even choice of {} of {} points a panel is drawn; the curve uses all of them.",
        kMostFormulaPoints, most));
  return out;
}

void draw_formula(const RunResults& results, const FormulaPoints& one, draw::Panel& panel) {
  const FormulaCurve curve = curve_of(one);
  panel.band(curve.low, curve.high, Tone::kBand);
  panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
  const double stride = std::max(
      1.0, static_cast<double>(one.poses.size()) / static_cast<double>(kMostFormulaPoints));
  for (const bool is_held : {false, true})  // these on top
    for (double at = 0.0; at < static_cast<double>(one.poses.size()); at += stride) {
      const auto& pose = one.poses[static_cast<std::size_t>(at)];
      if (pose.held != is_held) continue;
      draw::Mark mark{.fill = is_held ? draw::Mark::Fill::kFilled : draw::Mark::Fill::kHollow,
                      .size = 3.0,
                      .pose = results.pose(pose.row)};
      mark.words =
          fmt::format("{}: {} {}, {} {}, formula {} {}", mark.pose, draw::digits(pose.input, 3),
                      one.input_unit, draw::digits(1e6 * pose.value, 3), unit_of(one),
                      draw::digits(1e6 * pose.law, 3), unit_of(one));
      panel.mark(pose.input, std::clamp(1e6 * pose.value, panel.y_low(), panel.y_high()), mark);
    }
  panel.line(curve.middle, {.paint = Tone::kPaper, .width = 4.0});
  panel.line(curve.middle, {.paint = Tone::kInk, .width = 2.0});
}

/// The range of the vertical axis: it holds zero, the law, and all points but the outermost
/// hundredth.
std::pair<double, double> value_range(const FormulaPoints& one) {
  std::vector<double> values;
  double low = 0.0, high = 0.0;
  for (const auto& pose : one.poses) {
    values.push_back(pose.value);
    low = std::min(low, pose.law), high = std::max(high, pose.law);
  }
  std::sort(values.begin(), values.end());
  return {1e6 * std::min(low, quantile_of(values, 0.005)),
          1e6 * std::max(high, quantile_of(values, 0.995))};
}

}  // namespace

std::string formulas_figure(const RunResults& results, double width) {
  const auto all = formula_points(results);
  std::vector<draw::LegendEntry> legend;
  if (!all.empty()) {
    legend = pose_legend(results);
    legend.push_back({.words = "fitted formula", .line = draw::LineStyle{Tone::kInk, 2.0}});
    legend.push_back({.words = "its 95 % interval", .area = Tone::kBand});
  }
  draw::Sheet sheet(width, {.title = "Formulas of the model, with what they explain",
                            .sentence = formulas_sentence(all),
                            .legend = std::move(legend),
                            .notes = formulas_notes(results, all)});
  const auto rooms = sheet.grid(static_cast<int>(all.size()), all.size() == 1 ? 320.0 : 380.0,
                                all.size() == 1 ? 380.0 : 290.0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const FormulaPoints& one = all[k];
    const auto [low, high] = value_range(one);
    const bool some = !one.poses.empty();
    draw::Panel panel(
        sheet.svg(), rooms[k],
        {.title =
             one.input_unit.empty() ? one.input : fmt::format("{} [{}]", one.input, one.input_unit),
         .low = some ? one.poses.front().input : 0.0,
         .high = some ? one.poses.back().input : 1.0},
        {.title = fmt::format("what it has to explain [{}]", unit_of(one)),
         .low = low,
         .high = high},
        one.formula);
    draw_formula(results, one, panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#include "report/fleet_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "effects/registry.hpp"
#include "figures/error_axis.hpp"
#include "show/fleet_view.hpp"
#include "show/parameter_unit.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

using draw::Tone;
using fleet::CellSummary;
using fleet::Fleet;
using fleet::Model;
using fleet::Typical;

constexpr double kErrorsHeight = 320.0;                  // [px]
constexpr double kRowHeight = 17.0, kAroundRows = 60.0;  // [px]

const draw::Mark kGood{.shape = draw::Shape::kCircle, .paint = Tone::kGreen};
const draw::Mark kPartly{.shape = draw::Shape::kSquare, .paint = Tone::kOrange};
const draw::Mark kNotGood{.shape = draw::Shape::kDiamond, .paint = Tone::kVermilion, .size = 5.0};
const draw::Mark kUnlike{.shape = draw::Shape::kTriangle, .paint = Tone::kPurple, .size = 5.5};

std::vector<const CellSummary*> from_best_to_worst(const Fleet& fleet) {
  std::vector<const CellSummary*> out;
  for (const auto& cell : fleet.cells)
    if (cell.ok && cell.held.n > 0) out.push_back(&cell);
  std::stable_sort(out.begin(), out.end(), [](const CellSummary* a, const CellSummary* b) {
    return a->held.p95 < b->held.p95;
  });
  return out;
}

draw::Mark mark_of(const CellSummary& cell) {
  return cell.verdict_class == "good" ? kGood : cell.verdict_class == "bad" ? kNotGood : kPartly;
}

std::string errors_sentence(const std::vector<const CellSummary*>& sorted) {
  const auto good =
      std::count_if(sorted.begin(), sorted.end(), [](const CellSummary* c) { return c->good; });
  return fmt::format(
      "{} of {} arms keep{} {} tolerance; of the median arm 95 % of the poses "
      "miss by up to {} mm, of the worst, {}, by up to {} mm.",
      good, sorted.size(), good == 1 ? "s" : "", good == 1 ? "its" : "their",
      show::mm(sorted[sorted.size() / 2]->held.p95), sorted.back()->name,
      show::mm(sorted.back()->held.p95));
}

std::string sisters_sentence(const Model& model) {
  const auto& odd = model.sisters.odd;
  if (odd.empty())
    return fmt::format(
        "The {} arms of this model differ as arms of one model do: none is unlike "
        "its sisters.",
        model.arms);
  return fmt::format(
      "{} of the {} arms {} unlike {} sisters: {} in {}, {:.0f} standard deviations "
      "away{}.",
      odd.size(), model.arms, odd.size() == 1 ? "is" : "are", odd.size() == 1 ? "its" : "their",
      odd.front().cell, odd.front().number, odd.front().times,
      odd.size() > 1 ? ", and others" : "");
}

std::vector<const Typical*> geometry_of(const Model& model, bool lengths) {
  std::vector<const Typical*> out;
  for (const auto& t : model.sisters.typical)
    if (is_geometry(t.effect) && (t.unit == "m") == lengths) out.push_back(&t);
  return out;
}

const fleet::ArmNumber* number_of(const Fleet& fleet, const std::string& cell,
                                  const std::string& number) {
  for (const auto& one : fleet.cells)
    if (one.name == cell)
      for (const auto& n : one.numbers)
        if (n.name == number) return &n;
  return nullptr;
}

void draw_numbers(const Fleet& fleet, const Model& model, const std::vector<const Typical*>& rows,
                  bool lengths, draw::Sheet& sheet) {
  if (rows.empty()) return;
  const std::string unit = lengths ? "mm" : "deg";
  const auto shown = [&](double si) { return show::shown(si, lengths); };
  double most = 0.0;
  for (const Typical* t : rows) most = std::max(most, shown(std::abs(t->mean) + 2.0 * t->sd));
  const auto last = static_cast<double>(rows.size() - 1);
  draw::Axis y{.low = -0.6, .high = last + 0.6, .ticks = {}};
  for (std::size_t i = 0; i < rows.size(); ++i)
    y.ticks.push_back({last - static_cast<double>(i), rows[i]->name});
  for (const auto& odd : model.sisters.odd)
    for (const Typical* t : rows)
      if (const auto* n = number_of(fleet, odd.cell, t->name))
        most = std::max(most, shown(std::abs(n->value)));
  const draw::Axis x{.title = fmt::format("difference from nominal [{}]", unit),
                     .low = -1.05 * most,
                     .high = 1.05 * most,
                     .ticks = {}};
  draw::Panel panel(sheet.svg(),
                    sheet.room(kAroundRows + kRowHeight * static_cast<double>(rows.size())), x, y,
                    lengths ? "lengths" : "angles");
  panel.levels_x({{0.0, "", {.paint = Tone::kMuted}}});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Typical& t = *rows[i];
    const double at = last - static_cast<double>(i);
    panel.line({{shown(t.mean - t.sd), at}, {shown(t.mean + t.sd), at}},
               {.paint = Tone::kBlue, .width = 5.0});
    panel.mark(shown(t.mean), at,
               {.paint = Tone::kInk,
                .words = fmt::format("{}: {:.4f} {} on average, {:.4f} {} from arm to arm", t.name,
                                     shown(t.mean), unit, shown(t.sd), unit)});
    for (const auto& odd : model.sisters.odd)
      if (const auto* n = number_of(fleet, odd.cell, t.name)) {
        draw::Mark mark = kUnlike;
        mark.size = n->name == odd.number ? 5.5 : 3.0;
        mark.words = fmt::format("{}: {} is {:.4f} {}", odd.cell, n->name, shown(n->value), unit);
        panel.mark(shown(n->value), at, mark);
      }
  }
}

}  // namespace

std::string fleet_errors_figure(const Fleet& fleet, double width) {
  const auto sorted = from_best_to_worst(fleet);
  if (sorted.empty()) return {};
  draw::Sheet sheet(
      width,
      {.title = "Is the calibration of every arm good?",
       .sentence = errors_sentence(sorted),
       .legend = {{.words = "good", .mark = kGood},
                  {.words = "in part", .mark = kPartly},
                  {.words = "not good enough", .mark = kNotGood},
                  {.words = "unlike its sisters", .mark = kUnlike}},
       .notes = {
           "Length of e = measured - predicted that 95 % of the held-out poses of each arm keep, "
           "which is what the tolerance is judged by; an arm may also miss it by a single "
           "pose that is far off. An in-sample error is no accuracy and is not shown."}});
  double most = sorted.back()->held.p95, low = sorted.front()->held.p95;
  bool one_tolerance = true;
  for (const auto* cell : sorted) {
    most = std::max(most, cell->tolerance_m);
    one_tolerance = one_tolerance && cell->tolerance_m == sorted.front()->tolerance_m;
  }
  const bool log = low > 0.0 && most > figures::kLogBeyond * low;
  const draw::Axis y{.title = "held-out error that 95 % of the poses keep [mm]",
                     .low = log ? 0.5e3 * low : 0.0,
                     .high = 1.1e3 * most,
                     .scale = log ? draw::Axis::Scale::kLog : draw::Axis::Scale::kLinear,
                     .ticks = {}};
  const draw::Axis x{.title = "arms, from the best to the worst",
                     .low = 0.0,
                     .high = static_cast<double>(sorted.size()) + 1.0,
                     .ticks = {}};
  draw::Panel panel(sheet.svg(), sheet.room(kErrorsHeight), x, y);
  const auto draw_arms = [&](bool odd) {
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const CellSummary& cell = *sorted[i];
      if ((show::odd_arm(fleet, cell.name) != nullptr) != odd) continue;
      draw::Mark mark = odd ? kUnlike : mark_of(cell);
      mark.words = fmt::format("{}: {}; {} mm in 95 % of the poses, {} mm at most", cell.name,
                               cell.verdict_head, show::mm(cell.held.p95), show::mm(cell.held.max));
      panel.mark(static_cast<double>(i + 1), cell.held.p95 * 1e3, mark);
    }
  };
  draw_arms(false);
  draw_arms(true);  // above the others
  if (one_tolerance)
    panel.levels_y({{sorted.front()->tolerance_m * 1e3,
                     "tolerance",
                     {.paint = Tone::kVermilion, .width = 1.4, .dashes = "6 3"}}});
  return sheet.file();
}

std::string sisters_figure(const Fleet& fleet, const Model& model, double width) {
  if (model.sisters.typical.empty()) return {};
  draw::Sheet sheet(
      width,
      {.title = fmt::format("What the arms have in common: {}", show::model_name(model)),
       .sentence = sisters_sentence(model),
       .legend = {{.words = "mean of the arms", .mark = draw::Mark{.paint = Tone::kInk}},
                  {.words = "one standard deviation from arm to arm",
                   .line = draw::LineStyle{.paint = Tone::kBlue, .width = 5.0}},
                  {.words = "an arm unlike its sisters", .mark = kUnlike}},
       .notes = {"Noise of the fits is taken off; the arms unlike their sisters teach nothing."}});
  draw_numbers(fleet, model, geometry_of(model, true), true, sheet);
  draw_numbers(fleet, model, geometry_of(model, false), false, sheet);
  return sheet.file();
}

}  // namespace plumb::offline::report

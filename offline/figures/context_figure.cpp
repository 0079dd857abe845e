// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "draw/text_width.hpp"
#include "figures/model_figures.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostContextPoints = 300;  // in each panel
constexpr int kContextSteps = 10;                // of the local means
constexpr double kFewestInStep = 4.0;            // poses, for a mean and its interval
constexpr double kContext95 = 1.96;
constexpr double kClearSlope = 4.0;  // standard errors of a slope, of a dozen that are looked at
constexpr std::array<const char*, 3> kComponent{"x", "y", "z"};

/// One quantity that was known at the poses, and the rows at which it was.
struct Known {
  std::string name, unit;
  std::vector<int> rows;  // by value
  std::vector<double> value;
};

const char* name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kTemperature:
      return "temperature";
    case Quantity::kPayload:
      return "payload";
    default:
      return "time";
  }
}

std::vector<int> rows_of(const RunResults& results) {
  std::vector<int> out = results.held;
  out.insert(out.end(), results.fit.begin(), results.fit.end());
  std::sort(out.begin(), out.end());
  const Fit& fit = results.run.fit;
  return without_outliers(without_outliers(out, fit.calibration.outliers), fit.held_outliers);
}

template <class Value>
void add_known(const RunResults& results, std::string name, std::string unit, const Value& value,
               std::vector<Known>& out) {
  std::vector<std::pair<double, int>> all;
  for (const int row : rows_of(results))
    if (const double v = value(row); std::isfinite(v)) all.emplace_back(v, row);
  if (all.empty()) return;
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Known one{std::move(name), std::move(unit), {}, {}};
  for (const auto& [v, row] : all) one.value.push_back(v), one.rows.push_back(row);
  out.push_back(std::move(one));
}

std::vector<Known> known_of(const RunResults& results, Quantity quantity) {
  const ContextRows& context = results.measured.context;
  std::vector<Known> out;
  if (quantity == Quantity::kTemperature && context.temperature.rows() > 0)
    for (std::size_t k = 0; k < context.sensors.size(); ++k)
      add_known(
          results, context.sensors[k], "degC",
          [&](int row) { return context.temperature(row, static_cast<Eigen::Index>(k)); }, out);
  if (quantity == Quantity::kPayload && context.payload.rows() > 0)
    add_known(
        results, "payload", "kg", [&](int row) { return context.payload(row, 0); }, out);
  if (quantity == Quantity::kTime && context.time_s.size() > 0) {
    double first = INFINITY;
    for (const double t : context.time_s)
      if (std::isfinite(t)) first = std::min(first, t);
    add_known(
        results, "time since the first pose", "min",
        [&](int row) { return (context.time_s(row) - first) / 60.0; }, out);
  }
  return out;
}

bool varies(const Known& known) {
  const double low = known.value.front(), high = known.value.back();
  return high - low > 1e-6 * std::max(std::abs(low), std::abs(high));
}

/// Slope of one component over the quantity, with the standard error that unequal scatter allows.
struct Slope {
  double value = 0.0, se = 0.0;  // [m] per unit
  double times() const { return se > 0.0 ? std::abs(value) / se : 0.0; }
};

Slope slope_of(const RunResults& results, const Known& known, int axis) {
  const auto n = static_cast<double>(known.rows.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, scatter = 0.0;
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    x += known.value[i] / n, y += results.after_M(known.rows[i], axis) / n;
  for (std::size_t i = 0; i < known.rows.size(); ++i) {
    const double dx = known.value[i] - x;
    xx += dx * dx, xy += dx * (results.after_M(known.rows[i], axis) - y);
  }
  if (!(xx > 0.0) || n < kFewestInStep) return {};
  Slope out{xy / xx, 0.0};
  for (std::size_t i = 0; i < known.rows.size(); ++i) {
    const double dx = known.value[i] - x;
    scatter += std::pow(dx * (results.after_M(known.rows[i], axis) - y - out.value * dx), 2);
  }
  out.se = std::sqrt(scatter * n / std::max(1.0, n - 2.0)) / xx;
  return out;
}

std::string context_sentence(const RunResults& results, Quantity quantity,
                             const std::vector<Known>& all) {
  if (all.empty())
    return fmt::format("The measurements do not say the {} at their poses.", name_of(quantity));
  const Known* where = nullptr;
  int axis = 0;
  Slope most;
  bool any = false;
  for (const Known& known : all) {
    if (!varies(known)) continue;
    any = true;
    for (int k = 0; k < 3; ++k) {
      if (!results.measured.has_axis[static_cast<std::size_t>(k)]) continue;
      const Slope slope = slope_of(results, known, k);
      if (slope.times() > most.times()) most = slope, where = &known, axis = k;
    }
  }
  if (!any)
    return fmt::format("The {} was the same at all poses: {:g} {}. Its influence cannot be seen.",
                       name_of(quantity), all.front().value.front(), all.front().unit);
  if (where == nullptr || most.times() < kClearSlope)
    return fmt::format("What is left does not follow the {} in any direction beyond chance.",
                       name_of(quantity));
  const double span = where->value.back() - where->value.front();
  return fmt::format(
      "What is left along {} follows {}: {} per {}, {:.0f} standard errors from zero, "
      "which makes {} over the range measured.",
      kComponent[static_cast<std::size_t>(axis)], where->name, length_text(most.value),
      where->unit == "degC" ? "K" : where->unit, most.times(),
      length_text(std::abs(most.value) * span));
}

struct ContextMeans {
  std::vector<draw::Point> middle, low, high;  // the last two: their 95 % intervals
};

/// Means over steps that hold equally many poses, or over the values if they are few.
ContextMeans means_of(const RunResults& results, const Known& known, int axis, double per_m) {
  std::vector<draw::Point> middle, low, high;
  const std::size_t n = known.rows.size();
  const std::size_t each = std::max<std::size_t>(4, (n + kContextSteps - 1) / kContextSteps);
  for (std::size_t from = 0; from < n;) {
    std::size_t to = std::min(n, from + each);
    while (to < n && known.value[to] == known.value[to - 1]) ++to;
    if (n - to < each / 2) to = n;
    double x = 0.0, y = 0.0, yy = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      const double e = per_m * results.after_M(known.rows[i], axis);
      x += known.value[i], y += e, yy += e * e;
    }
    const auto m = static_cast<double>(to - from);
    from = to;
    if (m < kFewestInStep) continue;
    const double half = kContext95 * std::sqrt(std::max(0.0, yy - y * y / m) / (m * (m - 1.0)));
    middle.push_back({x / m, y / m});
    low.push_back({x / m, y / m - half});
    high.push_back({x / m, y / m + half});
  }
  return {std::move(middle), std::move(low), std::move(high)};
}

}  // namespace

bool context_varies(const RunResults& results, Quantity quantity) {
  const auto all = known_of(results, quantity);
  return std::any_of(all.begin(), all.end(), [](const Known& known) { return varies(known); });
}

std::string context_figure(const RunResults& results, Quantity quantity, double width) {
  const auto all = known_of(results, quantity);
  auto notes = error_notes(results);
  std::size_t longest = 0;
  std::vector<double> sizes;
  for (const Known& known : all) {
    longest = std::max(longest, known.rows.size());
    for (const int row : known.rows)
      sizes.push_back(results.after_M.row(row).cwiseAbs().maxCoeff());
  }
  std::sort(sizes.begin(), sizes.end());
  const double most = std::max(1e-9, quantile_of(sizes, 0.99));
  const LengthUnit unit = unit_for(most);
  if (!all.empty())
    notes.emplace_back(
        "Components of e along the axes of the measurement frame, outliers left out; "
        "all panels have one scale, and points beyond it are drawn at its edge.");
  if (longest > kMostContextPoints)
    notes.push_back(
        fmt::format("An even choice of {} of {} points a panel is drawn; the means use "
                    "all.",
                    kMostContextPoints, longest));
  std::vector<draw::LegendEntry> legend;
  if (!all.empty()) {
    legend = pose_legend(results);
    legend.push_back(
        {.words = "mean of equally many poses", .line = draw::LineStyle{Tone::kInk, 2.0}});
    legend.push_back({.words = "its 95 % interval", .area = Tone::kBand});
  }
  draw::Sheet sheet(width,
                    {.title = fmt::format("What the model leaves, over {}", name_of(quantity)),
                     .sentence = context_sentence(results, quantity, all),
                     .legend = std::move(legend),
                     .notes = std::move(notes)});
  std::vector<int> axes;
  for (int k = 0; k < 3; ++k)
    if (results.measured.has_axis[static_cast<std::size_t>(k)]) axes.push_back(k);
  for (const Known& known : all) {
    const auto rooms = sheet.grid(static_cast<int>(axes.size()), 205.0, 270.0);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      draw::Panel panel(
          sheet.svg(), rooms[k],
          {.title = fmt::format("{} [{}]", draw::shortened(known.name, 11.5, 160.0), known.unit),
           .low = known.value.front(),
           .high = known.value.back()},
          {.title =
               fmt::format("e{} [{}]", kComponent[static_cast<std::size_t>(axes[k])], unit.name),
           .low = -most * unit.per_m,
           .high = most * unit.per_m});
      const ContextMeans means = means_of(results, known, axes[k], unit.per_m);
      panel.band(means.low, means.high, Tone::kBand);
      panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
      const double stride =
          std::max(1.0, static_cast<double>(known.rows.size()) / kMostContextPoints);
      for (const bool is_held : {false, true})  // these on top
        for (double at = 0.0; at < static_cast<double>(known.rows.size()); at += stride) {
          const auto i = static_cast<std::size_t>(at);
          const int row = known.rows[i];
          if (std::binary_search(results.held.begin(), results.held.end(), row) != is_held)
            continue;
          const double e = unit.per_m * results.after_M(row, axes[k]);
          panel.mark(known.value[i], std::clamp(e, panel.y_low(), panel.y_high()),
                     {.fill = is_held ? Mark::Fill::kFilled : Mark::Fill::kHollow,
                      .size = 2.4,
                      .pose = results.pose(row),
                      .words = pose_numbers(results, row)});
        }
      panel.line(means.middle, {.paint = Tone::kPaper, .width = 4.0});
      panel.line(means.middle, {.paint = Tone::kInk, .width = 2.0});
      for (const auto& mean : means.middle)
        panel.mark(mean.x, mean.y,
                   {.shape = draw::Shape::kSquare, .paint = Tone::kInk, .size = 2.5});
    }
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#include "figures/heat_map.hpp"

#include <algorithm>
#include <cmath>

#include "draw/ticks.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr int kColours = 64;  // steps of the scale
constexpr double kTallest = 460.0, kOfWidth = 0.72;

bool is_signed(const HeatMap& map) { return map.scale == ColourScale::kSigned; }

/// The colour as a whole number of steps from 0.
int step_of(const HeatMap& map, double value) {
  const double share = map.most > 0.0 ? value / map.most : 0.0;
  const double low = is_signed(map) ? -1.0 : 0.0;
  return std::isfinite(share)
             ? static_cast<int>(std::lround(std::clamp(share, low, 1.0) * (kColours - 1)))
             : 0;
}

draw::Paint colour_of(ColourScale scale, double share) {
  return scale == ColourScale::kSigned ? draw::signed_colour(share) : draw::magnitude_colour(share);
}

void draw_cells(const HeatMap& map, draw::Svg& svg, const draw::Panel& panel) {
  const auto rows = map.value.rows(), columns = map.value.cols();
  // Whole pixels: colours that let the ground through would show every seam and overlap.
  const auto x = [&](Eigen::Index c) {
    return std::round(panel.x_at(map.x_low + (map.x_high - map.x_low) * static_cast<double>(c) /
                                                 static_cast<double>(columns)));
  };
  const auto y = [&](Eigen::Index r) {
    return std::round(panel.y_at(map.y_low + (map.y_high - map.y_low) * static_cast<double>(r) /
                                                 static_cast<double>(rows)));
  };
  for (Eigen::Index r = 0; r < rows; ++r)
    for (Eigen::Index c = 0; c < columns;) {
      const int same = step_of(map, map.value(r, c));
      Eigen::Index end = c + 1;
      while (end < columns && step_of(map, map.value(r, end)) == same) ++end;
      if (same != 0 || !is_signed(map))
        svg.box({x(c), y(r + 1), x(end), y(r)},
                colour_of(map.scale, static_cast<double>(same) / (kColours - 1)));
      c = end;
    }
}

}  // namespace

draw::Panel draw_map(const HeatMap& map, draw::Svg& svg, const draw::Box& room,
                     const std::string& name) {
  draw::Panel panel(svg, room,
                    {.title = map.x_title,
                     .low = map.x_low,
                     .high = map.x_high,
                     .ends = draw::Axis::Ends::kExact},
                    {.title = map.y_title,
                     .low = map.y_low,
                     .high = map.y_high,
                     .ends = draw::Axis::Ends::kExact},
                    name);
  draw_cells(map, svg, panel);
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  std::vector<draw::Point> borders;
  for (const MapLine& line : map.lines)
    borders.insert(borders.end(), {{line.x0, line.y0}, {line.x1, line.y1}, {kGap, kGap}});
  if (!borders.empty()) panel.line(borders, {.paint = Tone::kInk, .width = 0.8});
  return panel;
}

std::vector<draw::LegendEntry> colour_legend(ColourScale scale, double most,
                                             const std::string& unit) {
  std::vector<draw::LegendEntry> out;
  const double low = scale == ColourScale::kSigned ? -1.0 : 0.0;
  for (int k = 0; k < 5; ++k) {
    const double share = low + (1.0 - low) * k / 4.0;
    out.push_back({.words = draw::digits(share * most, 2) + (k == 4 ? " " + unit : ""),
                   .area = colour_of(scale, share)});
  }
  return out;
}

std::string map_file(const HeatMap& map, draw::SheetText text, const std::string& unit,
                     double width) {
  text.legend = colour_legend(map.scale, map.most, unit);
  draw::Sheet sheet(width, std::move(text));
  draw_map(map, sheet.svg(), sheet.room(std::min(kTallest, kOfWidth * sheet.svg().width())));
  return sheet.file();
}

}  // namespace plumb::offline::figures

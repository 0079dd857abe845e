// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"

namespace plumb::offline::figures {

/// kMagnitude: 0 and more, dark to bright. kSigned: both ways from 0, blue or vermilion, the
/// fainter the nearer to 0.
enum class ColourScale { kMagnitude, kSigned };

/// A line drawn over the map, in the units of its axes.
struct MapLine {
  double x0, y0, x1, y1;
};

/// Values over a regular grid of two quantities.
struct HeatMap {
  std::string x_title, y_title;  // with units
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
  Eigen::MatrixXd value;  // (y, x), from low to high
  double most = 1.0;      // end of the colour scale; the same for figures to be compared
  ColourScale scale = ColourScale::kMagnitude;
  std::vector<MapLine> lines;
};

/// Draws the map into `room` and returns its panel. Neighbouring cells of one colour in a row
/// become one rectangle, so that the file stays small.
draw::Panel draw_map(const HeatMap& map, draw::Svg& svg, const draw::Box& room,
                     const std::string& name = {});

/// Five colours of the scale with their values, which end at `most` of that unit.
std::vector<draw::LegendEntry> colour_legend(ColourScale scale, double most,
                                             const std::string& unit);

/// The whole file of one map.
std::string map_file(const HeatMap& map, draw::SheetText text, const std::string& unit,
                     double width);

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumb::offline::show {

/// kMagnitude: 0 and more, dark to bright. kSigned: both ways from 0, blue to orange. Both can be
/// told apart by colour-blind readers and in grey.
enum class ColourScale { kMagnitude, kSigned };

/// A line drawn over the map, in the units of its axes.
struct MapLine {
  double x0, y0, x1, y1;
};

/// Values over a regular grid of two quantities.
struct HeatMap {
  std::string title, x_title, y_title, value_title;  // with units
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
  Eigen::MatrixXd value;  // (y, x), from low to high
  double most = 1.0;      // end of the colour scale; the same for figures to be compared
  ColourScale scale = ColourScale::kMagnitude;
  std::vector<MapLine> lines;
};

/// One self-contained SVG figure.
std::string svg(const HeatMap& map);

}  // namespace plumb::offline::show

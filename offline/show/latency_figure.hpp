// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/drivers/latency_histogram.hpp"

namespace plumb::offline::show {

struct LatencySeries {
  std::string name;
  drivers::LatencyHistogram histogram;
};

/// How often which latency occurred. Both axes are logarithmic: one late call in a million is seen
/// as well as the million.
struct LatencyFigure {
  std::string title;
  std::vector<std::string> notes;     // below the figure, a line each
  std::vector<LatencySeries> series;  // the first one filled, a second one as a line
};

/// One self-contained SVG figure; the worst of every series is marked and written at its place.
/// Blue and orange: told apart by colour-blind readers and, filled against line, in grey.
std::string svg(const LatencyFigure& figure);

}  // namespace plumb::offline::show

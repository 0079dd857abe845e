// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/svg.hpp"

namespace plumb::offline::draw {

inline constexpr double kNarrowest = 320.0, kWidest = 4000.0, kUsualWidth = 880.0;  // [px]

/// One entry of a legend: a sign, a line or an area, and its meaning.
struct LegendEntry {
  std::string words;
  std::optional<Mark> mark = {};
  std::optional<LineStyle> line = {};
  std::optional<Paint> area = {};
};

/// The words around a figure.
struct SheetText {
  std::string title;     // what is drawn
  std::string sentence;  // what to see in it, computed from the data
  std::vector<LegendEntry> legend = {};
  std::vector<std::string> notes = {};  // below the figure: conventions, counts, what was thinned
};

/// The page of one figure, from 320 to 4000 px wide: title, sentence and legend on top, room for
/// panels, notes below. All words are wrapped, so that a narrow figure is taller.
class Sheet {
 public:
  Sheet(double width, SheetText text);

  Svg& svg() { return svg_; }

  /// The room between the margins for panels of this height, below all rooms before it.
  Box room(double height);

  /// The rooms of `count` panels in rows, each at least `narrowest` px wide and `height` px tall.
  std::vector<Box> grid(int count, double narrowest, double height);

  /// The finished file.
  std::string file();

 private:
  void words(const std::string& text, const TextStyle& style, double leading);
  void legend();

  Svg svg_;
  SheetText text_;
  double y_ = 0.0;  // what is above this is taken
};

}  // namespace plumb::offline::draw

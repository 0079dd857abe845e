// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "draw/svg.hpp"
#include "draw/ticks.hpp"

namespace plumb::offline::draw {

/// One axis of a panel, in the units that its title states.
struct Axis {
  std::string title = {};  // with the unit: "error [mm]"; a logarithmic axis adds that it is one
  double low = 0.0, high = 1.0;
  enum class Scale { kLinear, kLog } scale = Scale::kLinear;
  enum class Ends { kRound, kExact } ends = Ends::kRound;  // whether the axis ends at ticks
  std::vector<Tick> ticks = {};  // given ones, such as names of categories; then ends are exact
};

/// A frame with two axes, round ticks and a grid, and what is drawn in it. As many ticks are drawn
/// as have room, at most kMostTicks; labels never touch.
class Panel {
 public:
  /// `outer` holds frame, ticks and titles. `name`: above the frame, of one of several panels.
  Panel(Svg& svg, const Box& outer, Axis x, Axis y, const std::string& name = {});

  const Box& plot() const { return plot_; }
  Point at(double x, double y) const { return {x_at(x), y_at(y)}; }
  double x_at(double value) const;
  double y_at(double value) const;
  double x_low() const { return x_.low; }
  double x_high() const { return x_.high; }
  double y_low() const { return y_.low; }
  double y_high() const { return y_.high; }

  void mark(double x, double y, const Mark& mark);

  /// Draws the part of the line that lies inside the frame.
  void line(const std::vector<Point>& values, const LineStyle& style);

  /// Between two curves over the same x; points are (x, low) and (x, high).
  void band(const std::vector<Point>& low, const std::vector<Point>& high, const Paint& paint);

  /// A rectangle with the corners (x0, y0) and (x1, y1), in the units of the axes.
  void bar(double x0, double y0, double x1, double y1, const Paint& paint,
           const LineStyle& edge = {.paint = {}}, const std::string& words = {});

  /// Lines across the panel at these x or y, each with its name if there is room for it: beside its
  /// line, where it covers the fewest marks and lines of those that were drawn before.
  struct Level {
    double at = 0.0;
    std::string words;
    LineStyle style;
  };
  void levels_x(const std::vector<Level>& levels);
  void levels_y(const std::vector<Level>& levels);

  /// A label beside the point (x, y), inside the frame, where it covers the fewest marks and lines.
  /// Returns whether there was room.
  bool label(double x, double y, const std::string& words,
             const TextStyle& style = {.size = 11.0, .halo = 3.0});

  /// A label that begins at (x, y), cut if it is wider than the rest of the frame.
  void label_at(double x, double y, const std::string& words);

 private:
  void draw_x_ticks(const std::vector<Tick>& ticks);
  void draw_y_ticks(const std::vector<Tick>& ticks);

  /// A position of a label and how much of the drawing it would cover there.
  struct LabelPosition {
    Point at;
    Anchor anchor = Anchor::kStart;
    double covered = 0.0;
  };
  void add_position(Point at, Anchor anchor, double words_width, double size,
                    std::vector<LabelPosition>& positions) const;
  bool put(std::vector<LabelPosition> positions, const std::string& words, const TextStyle& style);
  void ink_line(Point from, Point to);

  Svg& svg_;
  Axis x_, y_;
  Box plot_;
  std::vector<Box> ink_;    // of marks, and pieces of lines [px]
  std::vector<Box> areas_;  // of bars [px]
};

}  // namespace plumb::offline::draw

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "draw/paint.hpp"

namespace plumb::offline::draw {

/// A rectangle of the drawing [px]; y points down.
struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

struct Point {
  double x = 0.0, y = 0.0;
};

enum class Anchor { kStart, kMiddle, kEnd };

struct TextStyle {
  double size = 12.0;  // [px]
  Paint paint = Tone::kInk;
  enum class Weight { kNormal, kBold } weight = Weight::kNormal;
  double halo = 0.0;  // [px] of ground around the letters, over what is drawn below them
};

struct LineStyle {
  Paint paint = Tone::kInk;
  double width = 1.0;  // [px]
  std::string dashes = {};
};

enum class Shape { kCircle, kSquare, kTriangle, kTriangleRight, kDiamond, kCross };

/// A sign at a place. A pose is named, so that a page can find it, and its numbers stand in
/// `words`, which a browser shows when the mouse rests on it.
struct Mark {
  Shape shape = Shape::kCircle;
  Paint paint = Tone::kBlue;
  enum class Fill { kFilled, kHollow } fill = Fill::kFilled;
  double size = 3.5;  // half its width [px]
  std::string pose = {};
  std::string words = {};
};

/// The text as it may stand in XML, also in an attribute. Control characters, which XML forbids,
/// and bytes that are no UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// The elements of one drawing, in the order of painting. It remembers where texts are, so that a
/// label can be left out or moved rather than touch another one.
class Svg {
 public:
  explicit Svg(double width) : width_(width) {}

  double width() const { return width_; }

  /// Draws the text unless its box would touch that of a text drawn before, or leave the drawing at
  /// one side. Returns whether it was drawn. y: baseline.
  bool text(Point at, Anchor anchor, const std::string& words, const TextStyle& style = {});

  void line(Point from, Point to, const LineStyle& style);
  void polyline(const std::vector<Point>& points, const LineStyle& style);
  void area(const std::vector<Point>& outline, const Paint& fill, double opacity = 1.0);
  void box(const Box& box, const Paint& fill, const LineStyle& edge = {.paint = {}},
           const std::string& pose = {}, const std::string& words = {});
  void mark(Point at, const Mark& mark);

  /// Equal marks, or boxes of one paint, in one element: without names of poses, and with words
  /// that hold for all of them. A circle is drawn without an edge.
  void marks(const std::vector<Point>& at, const Mark& mark);
  void boxes(const std::vector<Box>& boxes, const Paint& fill);
  void arrow(Point from, Point to, const LineStyle& style, const std::string& pose = {},
             const std::string& words = {});

  /// Cuts off what is drawn outside the box, until `end_clip`.
  void clip(const Box& box);
  void end_clip();

  /// The whole file. `label`: what the figure is, for who cannot see it.
  std::string file(double height, const std::string& label) const;

 private:
  void attributes(const Paint& fill, const LineStyle& edge);
  void close(const char* element, const std::string& pose, const std::string& words);

  /// Elements in a row that are painted alike stand in one group, which says once how.
  void group(const Paint& fill, const LineStyle& edge);
  void end_group();

  double width_;
  std::vector<Box> texts_;
  std::string body_;
  std::string group_;  // how the open group is painted; empty: none is open
};

}  // namespace plumb::offline::draw

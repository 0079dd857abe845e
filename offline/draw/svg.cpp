// SPDX-License-Identifier: Apache-2.0
#include "draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "draw/text_width.hpp"
#include "program/utf8.hpp"

namespace plumb::offline::draw {
namespace {

constexpr double kAscent = 0.80, kDescent = 0.24;  // of the font size
constexpr double kGap = 2.0;                       // [px] between two texts
constexpr double kHead = 4.0;                      // of an arrow [px]
constexpr double kShortest = 5.0;                  // arrow that has a head [px]

constexpr double kBold = 1.12;  // times the width of normal letters

Box text_box(Point at, Anchor anchor, const std::string& words, const TextStyle& style) {
  const double size = style.size;
  const double w =
      text_width(words, size) * (style.weight == TextStyle::Weight::kBold ? kBold : 1.0);
  const double left = anchor == Anchor::kStart    ? at.x
                      : anchor == Anchor::kMiddle ? at.x - 0.5 * w
                                                  : at.x - w;
  return {left, at.y - kAscent * size, left + w, at.y + kDescent * size};
}

constexpr const char* name_of(Anchor anchor) {
  return anchor == Anchor::kStart ? "start" : anchor == Anchor::kMiddle ? "middle" : "end";
}

std::string path_of(Point at, Shape shape, double r) {
  switch (shape) {
    case Shape::kSquare:
      r *= 0.9;
      return fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", at.x - r, at.y - r, 2 * r, 2 * r,
                         -2 * r);
    case Shape::kTriangle:
      return fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}h{:.1f}z", at.x, at.y - 1.2 * r, 1.15 * r,
                         2.0 * r, -2.3 * r);
    case Shape::kDiamond:
      r *= 1.25;
      return fmt::format("M{0:.1f} {1:.1f}l{2:.1f} {2:.1f}l{3:.1f} {2:.1f}l{3:.1f} {3:.1f}z", at.x,
                         at.y - r, r, -r);
    default:
      return fmt::format("M{0:.1f} {1:.1f}l{2:.1f} {2:.1f}m0 {3:.1f}l{3:.1f} {2:.1f}", at.x - r,
                         at.y - r, 2 * r, -2 * r);
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bad = find_invalid_utf8(text.substr(i));
    const std::size_t end = bad == std::string_view::npos ? text.size() : i + bad;
    for (; i < end; ++i) {
      const char c = text[i];
      if (c == '<') {
        out += "&lt;";
      } else if (c == '>') {
        out += "&gt;";
      } else if (c == '&') {
        out += "&amp;";
      } else if (c == '"') {
        out += "&quot;";
      } else if (c == '\'') {
        out += "&#39;";
      } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
        out += c == '\t' || c == '\n' ? " " : "\uFFFD";
      } else {
        out += c;
      }
    }
    if (i < text.size()) {
      out += "\uFFFD";
      ++i;
    }
  }
  return out;
}

bool Svg::text(Point at, Anchor anchor, const std::string& words, const TextStyle& style) {
  if (words.empty()) return false;
  const Box box = text_box(at, anchor, words, style);
  if (!std::isfinite(at.x + at.y) || box.left < 0.0 || box.right > width_) return false;
  const Box wide{box.left - kGap, box.top - 0.5, box.right + kGap, box.bottom + 0.5};
  for (const Box& other : texts_)
    if (wide.overlaps(other)) return false;
  texts_.push_back(box);
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{:g}\"",
                       at.x, at.y, name_of(anchor), style.size);
  if (style.weight == TextStyle::Weight::kBold) body_ += " font-weight=\"600\"";
  if (style.halo > 0.0) body_ += " paint-order=\"stroke\" stroke-linejoin=\"round\"";
  attributes(style.paint,
             style.halo > 0.0 ? LineStyle{Tone::kPaper, style.halo} : LineStyle{Paint()});
  body_ += ">" + escaped(words) + "</text>\n";
  return true;
}

void Svg::attributes(const Paint& fill, const LineStyle& edge) {
  std::string classes;
  if (fill.is_tone()) classes = fmt::format("f{}", fill.tone());
  if (edge.paint.is_tone())
    classes += fmt::format("{}s{}", classes.empty() ? "" : " ", edge.paint.tone());
  if (!classes.empty()) body_ += " class=\"" + classes + "\"";
  body_ += fmt::format(" fill=\"{}\"", fill.value());
  if (fill.opacity() < 1.0) body_ += fmt::format(" fill-opacity=\"{:.2g}\"", fill.opacity());
  if (edge.paint.value() == "none") return;
  body_ += fmt::format(" stroke=\"{}\" stroke-width=\"{:g}\"", edge.paint.value(), edge.width);
  if (!edge.dashes.empty()) body_ += fmt::format(" stroke-dasharray=\"{}\"", edge.dashes);
}

void Svg::close(const char* element, const std::string& pose, const std::string& words) {
  if (!pose.empty()) body_ += fmt::format(" data-pose=\"{}\"", escaped(pose));
  if (words.empty())
    body_ += "/>\n";
  else
    body_ += fmt::format("><title>{}</title></{}>\n", escaped(words), element);
}

void Svg::line(Point from, Point to, const LineStyle& style) { polyline({from, to}, style); }

void Svg::polyline(const std::vector<Point>& points, const LineStyle& style) {
  if (points.empty()) return;
  body_ += "<path d=\"";
  bool begun = false;
  for (const Point& p : points) {
    if (!std::isfinite(p.x + p.y)) {
      begun = false;
      continue;
    }
    fmt::format_to(std::back_inserter(body_), "{}{:.1f} {:.1f}", begun ? 'L' : 'M', p.x, p.y);
    begun = true;
  }
  body_ += "\"";
  attributes({}, style);
  close("path", {}, {});
}

void Svg::area(const std::vector<Point>& outline, const Paint& fill, double opacity) {
  if (outline.size() < 3) return;  // a path must begin somewhere
  body_ += "<path d=\"";
  char move = 'M';
  for (const Point& p : outline) {
    if (!std::isfinite(p.x + p.y)) continue;
    fmt::format_to(std::back_inserter(body_), "{}{:.1f} {:.1f}", move, p.x, p.y);
    move = 'L';
  }
  body_ += "z\"";
  attributes(fill, {.paint = {}});
  if (opacity < 1.0) body_ += fmt::format(" fill-opacity=\"{:g}\"", opacity);
  close("path", {}, {});
}

void Svg::box(const Box& box, const Paint& fill, const LineStyle& edge, const std::string& pose,
              const std::string& words) {
  if (!std::isfinite(box.left + box.top + box.right + box.bottom)) return;
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"",
                       box.left, box.top, std::max(0.0, box.width()), std::max(0.0, box.height()));
  attributes(fill, edge);
  close("rect", pose, words);
}

void Svg::mark(Point at, const Mark& mark) {
  if (!std::isfinite(at.x + at.y)) return;
  const bool hollow = mark.fill == Mark::Fill::kHollow;
  const bool cross = mark.shape == Shape::kCross;
  const Paint fill = cross ? Paint() : hollow ? Paint(Tone::kPaper) : mark.paint;
  const LineStyle edge{.paint = hollow || cross ? mark.paint : Paint(Tone::kPaper),
                       .width = hollow || cross ? 1.3 : 0.6};
  if (mark.shape == Shape::kCircle)
    body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\"", at.x, at.y, mark.size);
  else
    body_ += fmt::format("<path d=\"{}\"", path_of(at, mark.shape, mark.size));
  attributes(fill, edge);
  close(mark.shape == Shape::kCircle ? "circle" : "path", mark.pose, mark.words);
}

void Svg::arrow(Point from, Point to, const LineStyle& style, const std::string& pose,
                const std::string& words) {
  if (!std::isfinite(from.x + from.y + to.x + to.y)) return;
  body_ += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}", from.x, from.y, to.x, to.y);
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length > kShortest) {
    const double ux = kHead * (to.x - from.x) / length, uy = kHead * (to.y - from.y) / length;
    for (const double side : {-0.5, 0.5})
      body_ += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", to.x, to.y, to.x - ux + side * uy,
                           to.y - uy - side * ux);
  }
  body_ += "\"";
  attributes({}, style);
  close("path", pose, words);
}

void Svg::clip(const Box& box) {
  // A nested drawing clips by itself; an identifier could occur twice in a page.
  body_ += fmt::format(
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" "
      "viewBox=\"{0:.1f} {1:.1f} {2:.1f} {3:.1f}\">\n",
      box.left, box.top, box.width(), box.height());
}

void Svg::end_clip() { body_ += "</svg>\n"; }

std::string Svg::file(double height, const std::string& label) const {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plumb-figure\" role=\"img\" "
             "aria-label=\"{2}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
             "height=\"{1:.0f}\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\">\n"
             "<style>\n",
             width_, std::ceil(height), escaped(label)) +
         style_sheet() +
         fmt::format(
             "</style>\n<rect class=\"f0\" width=\"{:.0f}\" height=\"{:.0f}\" "
             "fill=\"#ffffff\"/>\n",
             width_, std::ceil(height)) +
         body_ + "</svg>\n";
}

}  // namespace plumb::offline::draw

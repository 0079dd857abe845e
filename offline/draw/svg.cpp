// SPDX-License-Identifier: Apache-2.0
#include "draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// A coordinate [px], rounded to a tenth: "12.5", "12", "-3".
std::string number(double value) {
  std::string out = fmt::format("{:.1f}", value);
  if (out.ends_with(".0")) out.resize(out.size() - 2);
  return out == "-0" ? "0" : out;
}

/// Two numbers of a path. A minus sign separates them, so that no blank is needed before it.
std::string pair_of(double x, double y) {
  const std::string second = number(y);
  return number(x) + (second.front() == '-' ? "" : " ") + second;
}

std::string path_of(Point at, Shape shape, double r) {
  switch (shape) {
    case Shape::kSquare:
      r *= 0.9;
      return fmt::format("M{}h{}v{}h{}z", pair_of(at.x - r, at.y - r), number(2 * r), number(2 * r),
                         number(-2 * r));
    case Shape::kTriangle:
      return fmt::format("M{}l{}h{}z", pair_of(at.x, at.y - 1.2 * r), pair_of(1.15 * r, 2.0 * r),
                         number(-2.3 * r));
    case Shape::kTriangleRight:
      return fmt::format("M{}l{}v{}z", pair_of(at.x + 1.2 * r, at.y), pair_of(-2.0 * r, 1.15 * r),
                         number(-2.3 * r));
    case Shape::kDiamond:
      r *= 1.25;
      return fmt::format("M{}l{}l{}l{}z", pair_of(at.x, at.y - r), pair_of(r, r), pair_of(-r, r),
                         pair_of(-r, -r));
    default:
      return fmt::format("M{}l{}m0 {}l{}", pair_of(at.x - r, at.y - r), pair_of(2 * r, 2 * r),
                         number(-2 * r), pair_of(-2 * r, 2 * r));
  }
}

Paint fill_of(const Mark& mark) {
  if (mark.shape == Shape::kCross) return {};
  return mark.fill == Mark::Fill::kHollow ? Paint(Tone::kPaper) : mark.paint;
}

LineStyle edge_of(const Mark& mark) {
  const bool lined = mark.fill == Mark::Fill::kHollow || mark.shape == Shape::kCross;
  return {.paint = lined ? mark.paint : Paint(Tone::kPaper), .width = lined ? 1.3 : 0.6};
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
  end_group();
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

void Svg::group(const Paint& fill, const LineStyle& edge) {
  const std::size_t end = body_.size();
  attributes(fill, edge);
  std::string wanted = body_.substr(end);
  body_.resize(end);
  if (wanted == group_) return;
  end_group();
  body_ += "<g" + wanted + ">\n";
  group_ = std::move(wanted);
}

void Svg::end_group() {
  if (!group_.empty()) body_ += "</g>\n";
  group_.clear();
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
  end_group();
  body_ += "<path d=\"";
  bool begun = false;
  for (const Point& p : points) {
    if (!std::isfinite(p.x + p.y)) {
      begun = false;
      continue;
    }
    (body_ += begun ? 'L' : 'M') += pair_of(p.x, p.y);
    begun = true;
  }
  body_ += "\"";
  attributes({}, style);
  close("path", {}, {});
}

void Svg::area(const std::vector<Point>& outline, const Paint& fill, double opacity) {
  if (outline.size() < 3) return;  // a path must begin somewhere
  end_group();
  body_ += "<path d=\"";
  char move = 'M';
  for (const Point& p : outline) {
    if (!std::isfinite(p.x + p.y)) continue;
    (body_ += move) += pair_of(p.x, p.y);
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
  group(fill, edge);
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", number(box.left),
                       number(box.top), number(std::max(0.0, box.width())),
                       number(std::max(0.0, box.height())));
  close("rect", pose, words);
}

void Svg::boxes(const std::vector<Box>& boxes, const Paint& fill) {
  std::string path;
  for (const Box& box : boxes)
    if (std::isfinite(box.left + box.top + box.right + box.bottom))
      path += fmt::format("M{}h{}v{}h{}z", pair_of(box.left, box.top), number(box.width()),
                          number(box.height()), number(-box.width()));
  if (path.empty()) return;
  end_group();
  body_ += "<path d=\"" + path + "\"";
  attributes(fill, {.paint = {}});
  close("path", {}, {});
}

void Svg::mark(Point at, const Mark& mark) {
  if (!std::isfinite(at.x + at.y)) return;
  group(fill_of(mark), edge_of(mark));
  const bool circle = mark.shape == Shape::kCircle;
  if (circle)
    body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:g}\"", number(at.x), number(at.y),
                         mark.size);
  else
    body_ += fmt::format("<path d=\"{}\"", path_of(at, mark.shape, mark.size));
  close(circle ? "circle" : "path", mark.pose, mark.words);
}

void Svg::marks(const std::vector<Point>& at, const Mark& mark) {
  const bool circle = mark.shape == Shape::kCircle;
  std::string path;
  for (const Point& p : at)
    if (std::isfinite(p.x + p.y))
      path += circle ? "M" + pair_of(p.x, p.y) + "h0" : path_of(p, mark.shape, mark.size);
  if (path.empty()) return;
  end_group();
  body_ += "<path d=\"" + path + "\"";
  if (circle) {  // each is a line of length 0 with round ends
    body_ += " stroke-linecap=\"round\"";
    attributes({}, {.paint = mark.paint, .width = 2.0 * mark.size});
  } else {
    attributes(fill_of(mark), edge_of(mark));
  }
  close("path", {}, mark.words);
}

void Svg::arrow(Point from, Point to, const LineStyle& style, const std::string& pose,
                const std::string& words) {
  if (!std::isfinite(from.x + from.y + to.x + to.y)) return;
  group({}, style);
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  body_ += "<path d=\"M" + pair_of(from.x, from.y) + "l" + pair_of(dx, dy);
  if (length > kShortest) {
    // From one barb over the tip to the other.
    const double ux = kHead * dx / length, uy = kHead * dy / length;
    body_ += "m" + pair_of(-ux - 0.5 * uy, -uy + 0.5 * ux) + "l" +
             pair_of(ux + 0.5 * uy, uy - 0.5 * ux) + "l" + pair_of(-ux + 0.5 * uy, -uy - 0.5 * ux);
  }
  body_ += "\"";
  close("path", pose, words);
}

void Svg::clip(const Box& box) {
  // A nested drawing clips by itself; an identifier could occur twice in a page.
  end_group();
  body_ += fmt::format(
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" "
      "viewBox=\"{0:.1f} {1:.1f} {2:.1f} {3:.1f}\">\n",
      box.left, box.top, box.width(), box.height());
}

void Svg::end_clip() {
  end_group();
  body_ += "</svg>\n";
}

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
         body_ + (group_.empty() ? "" : "</g>\n") + "</svg>\n";
}

}  // namespace plumb::offline::draw

// SPDX-License-Identifier: Apache-2.0
#include "draw/panel.hpp"

#include <algorithm>
#include <cmath>

#include "draw/text_width.hpp"

namespace plumb::offline::draw {
namespace {

constexpr double kTickSize = 11.0, kTitleSize = 11.5, kNameSize = 12.5;
constexpr double kTickRoom = 24.0, kLogTickRoom = 18.0;  // [px] of a y axis for each tick
constexpr double kTickGap = 12.0;                        // [px] between the labels of an x axis
constexpr double kLine = 16.0, kHalo = 3.0;

double share_of(const Axis& axis, double value) {
  if (axis.scale == Axis::Scale::kLinear) return (value - axis.low) / (axis.high - axis.low);
  return std::log(std::max(value, 1e-300) / axis.low) / std::log(axis.high / axis.low);
}

std::vector<Tick> ticks_of(const Axis& axis, int most) {
  if (!axis.ticks.empty()) return axis.ticks;
  auto out = axis.scale == Axis::Scale::kLog ? log_ticks(axis.low, axis.high, most)
                                             : round_ticks(axis.low, axis.high, most);
  if (axis.ends == Axis::Ends::kExact)
    std::erase_if(out, [&](const Tick& t) {
      return share_of(axis, t.value) < -1e-9 || share_of(axis, t.value) > 1.0 + 1e-9;
    });
  return out;
}

bool too_crowded(const std::vector<Tick>& ticks, double width) {
  double sum = 0.0;
  for (const Tick& tick : ticks) sum = std::max(sum, text_width(tick.text, kTickSize) + kTickGap);
  return sum * static_cast<double>(ticks.size()) > width;
}

void end_at_ticks(Axis& axis, const std::vector<Tick>& ticks) {
  if (axis.ends == Axis::Ends::kExact || !axis.ticks.empty() || ticks.empty()) return;
  axis.low = ticks.front().value;
  axis.high = ticks.back().value;
}

/// An exact axis still needs a range that can be drawn.
void make_sound(Axis& axis) {
  const bool log = axis.scale == Axis::Scale::kLog;
  const bool good = std::isfinite(axis.low) && std::isfinite(axis.high) && axis.high > axis.low &&
                    (!log || axis.low > 0.0);
  if (good || (axis.ends == Axis::Ends::kRound && axis.ticks.empty())) return;
  const auto ticks = log ? log_ticks(axis.low, axis.high, 3) : round_ticks(axis.low, axis.high, 3);
  axis.low = ticks.front().value;
  axis.high = ticks.back().value;
}

std::string title_of(const Axis& axis) {
  if (axis.scale == Axis::Scale::kLinear || axis.title.empty()) return axis.title;
  return axis.title + ", log scale";
}

}  // namespace

Panel::Panel(Svg& svg, const Box& outer, Axis x, Axis y, const std::string& name)
    : svg_(svg), x_(std::move(x)), y_(std::move(y)) {
  make_sound(x_);
  make_sound(y_);
  const std::string x_title = title_of(x_), y_title = title_of(y_);
  plot_ = outer;
  plot_.top += 6.0;
  if (!name.empty()) {
    plot_.top += kLine;
    svg_.text({outer.left, plot_.top - 4.0}, Anchor::kStart,
              shortened(name, kNameSize, outer.width() / 1.15),
              {.size = kNameSize, .weight = TextStyle::Weight::kBold});
  }
  if (!y_title.empty()) {
    plot_.top += kLine + 5.0;
    svg_.text({outer.left, plot_.top - 10.0}, Anchor::kStart,
              shortened(y_title, kTitleSize, outer.width()),
              {.size = kTitleSize, .paint = Tone::kMuted});
  }
  plot_.bottom -= 21.0 + (x_title.empty() ? 0.0 : kLine);
  const double each = y_.scale == Axis::Scale::kLog ? kLogTickRoom : kTickRoom;
  const auto y_ticks = ticks_of(y_, static_cast<int>(plot_.height() / each));
  end_at_ticks(y_, y_ticks);
  double widest = 0.0;
  for (const Tick& tick : y_ticks) widest = std::max(widest, text_width(tick.text, kTickSize));
  plot_.left += std::min(widest, 0.4 * outer.width()) + 8.0;
  std::vector<Tick> x_ticks;
  for (int most = kMostTicks; most >= 3; --most) {
    x_ticks = ticks_of(x_, most);
    if (!x_.ticks.empty() || !too_crowded(x_ticks, plot_.width())) break;
  }
  end_at_ticks(x_, x_ticks);
  if (!x_ticks.empty() && x_.ticks.empty())
    plot_.right -= 0.5 * text_width(x_ticks.back().text, kTickSize) + 1.0;
  svg_.box(plot_, Tone::kPaper);
  draw_x_ticks(x_ticks);
  draw_y_ticks(y_ticks);
  svg_.box(plot_, {}, {.paint = Tone::kMuted, .width = 1.0});
  if (!x_title.empty())
    svg_.text({plot_.right, outer.bottom - 3.0}, Anchor::kEnd,
              shortened(x_title, kTitleSize, outer.width() - 8.0),
              {.size = kTitleSize, .paint = Tone::kMuted});
}

void Panel::draw_x_ticks(const std::vector<Tick>& ticks) {
  for (const Tick& tick : ticks) {
    const double x = x_at(tick.value);
    if (x_.ticks.empty()) svg_.line({x, plot_.top}, {x, plot_.bottom}, {.paint = Tone::kGrid});
    svg_.text({x, plot_.bottom + 17.0}, Anchor::kMiddle, tick.text, {.size = kTickSize});
  }
}

void Panel::draw_y_ticks(const std::vector<Tick>& ticks) {
  for (const Tick& tick : ticks) {
    const double y = y_at(tick.value);
    if (y_.ticks.empty()) svg_.line({plot_.left, y}, {plot_.right, y}, {.paint = Tone::kGrid});
    svg_.text({plot_.left - 5.0, y + 4.0}, Anchor::kEnd,
              shortened(tick.text, kTickSize, plot_.left), {.size = kTickSize});
  }
}

double Panel::x_at(double value) const { return plot_.left + plot_.width() * share_of(x_, value); }

double Panel::y_at(double value) const {
  return plot_.bottom - plot_.height() * share_of(y_, value);
}

void Panel::mark(double x, double y, const Mark& mark) { svg_.mark(at(x, y), mark); }

void Panel::line(const std::vector<Point>& values, const LineStyle& style) {
  std::vector<Point> points;
  points.reserve(values.size());
  for (const Point& v : values) points.push_back(at(v.x, v.y));
  svg_.polyline(points, style);
}

void Panel::band(const std::vector<Point>& low, const std::vector<Point>& high,
                 const Paint& paint) {
  std::vector<Point> outline;
  for (const Point& v : low) outline.push_back(at(v.x, std::clamp(v.y, y_.low, y_.high)));
  for (auto v = high.rbegin(); v != high.rend(); ++v)
    outline.push_back(at(v->x, std::clamp(v->y, y_.low, y_.high)));
  svg_.area(outline, paint, 0.8);
}

void Panel::bar(double x0, double y0, double x1, double y1, const Paint& paint,
                const LineStyle& edge, const std::string& words) {
  const Point a = at(x0, y0), b = at(x1, y1);
  svg_.box({std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)}, paint,
           edge, {}, words);
}

bool Panel::inside(double left, double top, double right, double bottom) const {
  return left >= plot_.left && right <= plot_.right && top >= plot_.top && bottom <= plot_.bottom;
}

void Panel::level_x(double x, const std::string& words, const LineStyle& style) {
  const double px = x_at(x);
  if (!(px >= plot_.left - 0.5 && px <= plot_.right + 0.5)) return;
  svg_.line({px, plot_.top}, {px, plot_.bottom}, style);
  const TextStyle text{.size = kTickSize, .paint = style.paint, .halo = kHalo};
  const double w = text_width(words, kTickSize);
  for (double y = plot_.top + 14.0; y < plot_.bottom - 4.0; y += kLine) {
    if (px + 4.0 + w < plot_.right && svg_.text({px + 4.0, y}, Anchor::kStart, words, text)) return;
    if (px - 4.0 - w > plot_.left && svg_.text({px - 4.0, y}, Anchor::kEnd, words, text)) return;
  }
}

void Panel::level_y(double y, const std::string& words, const LineStyle& style) {
  const double py = y_at(y);
  if (!(py >= plot_.top - 0.5 && py <= plot_.bottom + 0.5)) return;
  svg_.line({plot_.left, py}, {plot_.right, py}, style);
  const TextStyle text{.size = kTickSize, .paint = style.paint, .halo = kHalo};
  const double w = text_width(words, kTickSize);
  if (w + 8.0 > plot_.width()) return;
  for (const double offset : {-4.0, 13.0}) {
    if (!inside(plot_.right - w - 4.0, py + offset - 9.0, plot_.right, py + offset + 3.0)) continue;
    if (svg_.text({plot_.right - 4.0, py + offset}, Anchor::kEnd, words, text)) return;
    if (svg_.text({plot_.left + 4.0, py + offset}, Anchor::kStart, words, text)) return;
  }
}

void Panel::label_at(double x, double y, const std::string& words) {
  const Point p = at(x, y);
  svg_.text({p.x + 4.0, p.y}, Anchor::kStart, shortened(words, kTickSize, plot_.right - p.x - 8.0),
            {.size = kTickSize, .halo = kHalo});
}

bool Panel::label(double x, double y, const std::string& words, const TextStyle& style) {
  const Point p = at(x, y);
  const double w = text_width(words, style.size), h = style.size;
  for (const double dy : {-7.0, 4.0, -20.0, 14.0, 27.0})
    for (const bool right : {true, false}) {
      const double left = right ? p.x + 7.0 : p.x - 7.0 - w;
      if (!inside(left, p.y + dy - h, left + w, p.y + dy + 3.0)) continue;
      if (svg_.text({right ? left : p.x - 7.0, p.y + dy}, right ? Anchor::kStart : Anchor::kEnd,
                    words, style))
        return true;
    }
  return false;
}

}  // namespace plumb::offline::draw

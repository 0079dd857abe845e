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
constexpr double kInkStep = 5.0;         // [px] of a line that count as one mark
constexpr double kAreaWeight = 8.0;      // marks: what a bar under a label counts
constexpr double kLevelWeight = 1e4;     // marks: what another level under the name of one counts
constexpr std::size_t kMostInk = 20000;  // marks that labels avoid; more would take too long

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

/// What of a line from one point to the other lies inside the box [Liang and Barsky 1984]; false if
/// nothing does, or if a coordinate is no number.
bool clipped(const Box& box, Point& from, Point& to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  if (!std::isfinite(dx + dy + from.x + from.y)) return false;
  double enters = 0.0, leaves = 1.0;
  const auto cut = [&](double slope, double room) {
    if (slope == 0.0) return room >= 0.0;
    (slope < 0.0 ? enters = std::max(enters, room / slope)
                 : leaves = std::min(leaves, room / slope));
    return true;
  };
  if (!cut(-dx, from.x - box.left) || !cut(dx, box.right - from.x) || !cut(-dy, from.y - box.top) ||
      !cut(dy, box.bottom - from.y) || enters > leaves)
    return false;
  const Point start = from;
  if (leaves < 1.0) to = {start.x + leaves * dx, start.y + leaves * dy};
  if (enters > 0.0) from = {start.x + enters * dx, start.y + enters * dy};
  return true;
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

void Panel::mark(double x, double y, const Mark& mark) {
  const Point p = at(x, y);
  svg_.mark(p, mark);
  if (ink_.size() < kMostInk)
    ink_.push_back({p.x - mark.size, p.y - mark.size, p.x + mark.size, p.y + mark.size});
}

void Panel::ink_line(Point from, Point to) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const int pieces = std::max(1, static_cast<int>(std::min(length / kInkStep, 1e4)));
  for (int i = 0; i < pieces && ink_.size() < kMostInk; ++i) {
    const double share = (i + 0.5) / pieces;
    const Point p{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    ink_.push_back({p.x - 0.5, p.y - 0.5, p.x + 0.5, p.y + 0.5});
  }
}

void Panel::line(const std::vector<Point>& values, const LineStyle& style) {
  std::vector<Point> pieces;  // those inside the frame, with a gap where the line is outside
  const auto gap = [&] {
    if (!pieces.empty() && std::isfinite(pieces.back().x)) pieces.push_back({NAN, NAN});
  };
  for (std::size_t i = 1; i < values.size(); ++i) {
    Point from = at(values[i - 1].x, values[i - 1].y), to = at(values[i].x, values[i].y);
    const Point begin = from;
    if (!clipped(plot_, from, to)) {
      gap();
      continue;
    }
    if (from.x != begin.x || from.y != begin.y) gap();
    if (pieces.empty() || !std::isfinite(pieces.back().x)) pieces.push_back(from);
    pieces.push_back(to);
    ink_line(from, to);
  }
  svg_.polyline(pieces, style);
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
  const Box box{std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
  svg_.box(box, paint, edge, {}, words);
  if (paint.value() != "none")
    areas_.push_back(box);
  else
    ink_line({box.left, box.top}, {box.right, box.top});
}

void Panel::add_position(Point at, Anchor anchor, double words_width, double size,
                         std::vector<LabelPosition>& positions) const {
  const double left = anchor == Anchor::kStart ? at.x : at.x - words_width;
  const Box box{left, at.y - size, left + words_width, at.y + 3.0};
  if (box.left < plot_.left || box.right > plot_.right || box.top < plot_.top ||
      box.bottom > plot_.bottom)
    return;
  LabelPosition position{at, anchor, 0.0};
  for (const Box& one : ink_) position.covered += box.overlaps(one);
  for (const Box& one : areas_) position.covered += kAreaWeight * box.overlaps(one);
  positions.push_back(position);
}

bool Panel::put(std::vector<LabelPosition> positions, const std::string& words,
                const TextStyle& style) {
  std::stable_sort(
      positions.begin(), positions.end(),
      [](const LabelPosition& a, const LabelPosition& b) { return a.covered < b.covered; });
  return std::any_of(positions.begin(), positions.end(), [&](const LabelPosition& position) {
    return svg_.text(position.at, position.anchor, words, style);
  });
}

void Panel::levels_x(const std::vector<Level>& levels) {
  const auto is_inside = [&](const Level& level) {
    const double px = x_at(level.at);
    return px >= plot_.left - 0.5 && px <= plot_.right + 0.5;
  };
  for (const Level& level : levels) {
    if (!is_inside(level)) continue;
    const Point top{x_at(level.at), plot_.top}, bottom{x_at(level.at), plot_.bottom};
    svg_.line(top, bottom, level.style);
    ink_line(top, bottom);
  }
  for (const Level& level : levels) {
    if (!is_inside(level)) continue;
    const double px = x_at(level.at), w = text_width(level.words, kTickSize);
    std::vector<LabelPosition> positions;
    for (double y = plot_.top + 14.0; y < plot_.bottom - 4.0; y += kLine) {
      add_position({px + 4.0, y}, Anchor::kStart, w, kTickSize, positions);
      add_position({px - 4.0, y}, Anchor::kEnd, w, kTickSize, positions);
    }
    for (LabelPosition& position : positions) {
      const double left = position.anchor == Anchor::kStart ? position.at.x : position.at.x - w;
      for (const Level& other : levels)
        if (x_at(other.at) > left && x_at(other.at) < left + w) position.covered += kLevelWeight;
    }
    put(std::move(positions), level.words,
        {.size = kTickSize, .paint = level.style.paint, .halo = kHalo});
  }
}

void Panel::levels_y(const std::vector<Level>& levels) {
  const auto is_inside = [&](const Level& level) {
    const double py = y_at(level.at);
    return py >= plot_.top - 0.5 && py <= plot_.bottom + 0.5;
  };
  for (const Level& level : levels) {
    if (!is_inside(level)) continue;
    const Point left{plot_.left, y_at(level.at)}, right{plot_.right, y_at(level.at)};
    svg_.line(left, right, level.style);
    ink_line(left, right);
  }
  for (const Level& level : levels) {
    if (!is_inside(level)) continue;
    const double py = y_at(level.at), w = text_width(level.words, kTickSize);
    std::vector<LabelPosition> positions;
    for (const double share : {1.0, 0.0, 0.75, 0.5, 0.25})
      for (const double offset : {-4.0, 13.0})
        add_position({plot_.left + 4.0 + share * (plot_.width() - w - 8.0), py + offset},
                     Anchor::kStart, w, kTickSize, positions);
    for (LabelPosition& position : positions)
      for (const Level& other : levels)
        if (y_at(other.at) > position.at.y - kTickSize && y_at(other.at) < position.at.y + 3.0)
          position.covered += kLevelWeight;
    put(std::move(positions), level.words,
        {.size = kTickSize, .paint = level.style.paint, .halo = kHalo});
  }
}

void Panel::label_at(double x, double y, const std::string& words) {
  const Point p = at(x, y);
  svg_.text({p.x + 4.0, p.y}, Anchor::kStart, shortened(words, kTickSize, plot_.right - p.x - 8.0),
            {.size = kTickSize, .halo = kHalo});
}

bool Panel::label(double x, double y, const std::string& words, const TextStyle& style) {
  const Point p = at(x, y);
  const double w = text_width(words, style.size);
  std::vector<LabelPosition> positions;
  for (const double dy : {-7.0, 4.0, -20.0, 14.0, 27.0}) {
    add_position({p.x + 7.0, p.y + dy}, Anchor::kStart, w, style.size, positions);
    add_position({p.x - 7.0, p.y + dy}, Anchor::kEnd, w, style.size, positions);
  }
  return put(std::move(positions), words, style);
}

}  // namespace plumb::offline::draw

// SPDX-License-Identifier: Apache-2.0
#include "draw/sheet.hpp"

#include <algorithm>
#include <cmath>

#include "draw/text_width.hpp"

namespace plumb::offline::draw {
namespace {

constexpr double kMargin = 14.0, kSign = 24.0, kLegendSize = 12.0, kLegendLine = 18.0,
                 kColumnGap = 16.0, kRowGap = 10.0;
constexpr double kBoldRoom = 0.88;  // of the width, for bold letters

double sound_width(double width) {
  return std::isfinite(width) ? std::clamp(width, kNarrowest, kWidest) : kUsualWidth;
}

}  // namespace

Sheet::Sheet(double width, SheetText text)
    : svg_(sound_width(width)), text_(std::move(text)), y_(kMargin) {
  words(text_.title, {.size = 16.0, .weight = TextStyle::Weight::kBold}, 21.0);
  words(text_.sentence, {.size = 13.0}, 18.0);
  y_ += 4.0;
  legend();
}

void Sheet::words(const std::string& text, const TextStyle& style, double leading) {
  const double room = svg_.width() - 2.0 * kMargin;
  const bool bold = style.weight == TextStyle::Weight::kBold;
  for (const auto& line : wrapped(text, style.size, bold ? kBoldRoom * room : room)) {
    y_ += leading;
    svg_.text({kMargin, y_ - 0.25 * leading}, Anchor::kStart, line, style);
  }
}

void Sheet::legend() {
  if (text_.legend.empty()) return;
  double x = kMargin;
  y_ += kLegendLine;
  for (const LegendEntry& entry : text_.legend) {
    const std::string words =
        shortened(entry.words, kLegendSize, svg_.width() - 2.0 * kMargin - kSign);
    const double w = kSign + text_width(words, kLegendSize) + kColumnGap;
    if (x > kMargin && x + w - kColumnGap > svg_.width() - kMargin) {
      x = kMargin;
      y_ += kLegendLine;
    }
    const double middle = y_ - 4.0;
    if (entry.area)
      svg_.box({x, middle - 5.0, x + 18.0, middle + 5.0}, *entry.area,
               {.paint = Tone::kMuted, .width = 0.5});
    if (entry.line) svg_.line({x, middle}, {x + 18.0, middle}, *entry.line);
    if (entry.mark) svg_.mark({x + 9.0, middle}, *entry.mark);
    svg_.text({x + kSign, y_}, Anchor::kStart, words, {.size = kLegendSize});
    x += w;
  }
  y_ += 6.0;
}

Box Sheet::room(double height) {
  const double top = y_ + kRowGap;
  y_ = top + height;
  return {kMargin, top, svg_.width() - kMargin, y_};
}

std::vector<Box> Sheet::grid(int count, double narrowest, double height) {
  const double width = svg_.width() - 2.0 * kMargin;
  const int fit = static_cast<int>((width + kColumnGap) / (narrowest + kColumnGap));
  const int most = std::max(1, std::min(fit, count));
  const int rows = (count + most - 1) / most;
  const int columns = rows > 0 ? (count + rows - 1) / rows : 1;  // rows of nearly equal length
  const double each = (width - kColumnGap * (columns - 1)) / columns;
  std::vector<Box> out;
  Box row;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns;
    if (column == 0) row = room(height);
    const double left = row.left + column * (each + kColumnGap);
    out.push_back({left, row.top, left + each, row.bottom});
  }
  return out;
}

std::string Sheet::file() {
  y_ += 6.0;
  for (const auto& note : text_.notes) words(note, {.size = 11.0, .paint = Tone::kMuted}, 15.0);
  return svg_.file(y_ + kMargin, text_.title + ". " + text_.sentence);
}

}  // namespace plumb::offline::draw

// SPDX-License-Identifier: Apache-2.0
#include "show/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plumb::offline::show {
namespace {

constexpr double kLeft = 70, kTop = 48, kWidth = 560, kHeight = 400, kBar = 18, kRight = 110,
                 kBottom = 56;
constexpr int kColours = 64;  // steps of the scale
constexpr int kTicks = 5;
constexpr double kSeam = 0.4;  // overlap of rectangles: no background shows between them

using Colour = std::array<double, 3>;

/// After cividis [Nunez 2018]: even steps of lightness, no red against green.
constexpr std::array<Colour, 5> kDarkToBright{
    {{0, 32, 77}, {65, 77, 107}, {124, 123, 120}, {188, 175, 111}, {255, 234, 70}}};
constexpr std::array<Colour, 5> kBlueToOrange{
    {{5, 78, 140}, {124, 174, 214}, {247, 247, 247}, {241, 163, 90}, {158, 72, 4}}};

/// share: 0 .. 1 of the scale.
std::string colour(const std::array<Colour, 5>& scale, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * 4.0;
  const auto i = static_cast<std::size_t>(std::min(3.0, std::floor(at)));
  const double part = at - static_cast<double>(i);
  std::string out = "#";
  for (std::size_t k = 0; k < 3; ++k)
    out += fmt::format(
        "{:02x}",
        static_cast<int>(std::lround(scale[i][k] + part * (scale[i + 1][k] - scale[i][k]))));
  return out;
}

/// Without a sign on zero.
std::string whole(double value) { return fmt::format("{:.0f}", std::round(value) + 0.0); }

class HeatMapDrawing {
 public:
  explicit HeatMapDrawing(const HeatMap& map) : map_(map) {}

  std::string text() {
    out_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        kLeft + kWidth + kRight, kTop + kHeight + kBottom);
    label(kLeft, 24, "start", map_.title, 15);
    cells();
    lines();
    axes();
    bar();
    return out_ + "</svg>\n";
  }

 private:
  double x(double value) const {
    return kLeft + kWidth * (value - map_.x_low) / (map_.x_high - map_.x_low);
  }
  double y(double value) const {
    return kTop + kHeight * (1.0 - (value - map_.y_low) / (map_.y_high - map_.y_low));
  }
  const std::array<Colour, 5>& scale() const {
    return map_.scale == ColourScale::kSigned ? kBlueToOrange : kDarkToBright;
  }
  double low() const { return map_.scale == ColourScale::kSigned ? -map_.most : 0.0; }

  int step(double value) const {
    const double share = map_.most > low() ? (value - low()) / (map_.most - low()) : 0.0;
    return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * (kColours - 1)));
  }

  void label(double at_x, double at_y, const char* anchor, const std::string& text, int size = 13) {
    std::string safe;
    for (char c : text)
      safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    out_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\">{}</text>\n", at_x,
        at_y, anchor, size, safe);
  }

  /// Neighbours of one colour in a row are one rectangle.
  void cells() {
    const auto rows = map_.value.rows(), columns = map_.value.cols();
    const double w = kWidth / static_cast<double>(columns), h = kHeight / static_cast<double>(rows);
    out_ += "<g shape-rendering=\"crispEdges\">\n";
    for (Eigen::Index r = 0; r < rows; ++r)
      for (Eigen::Index c = 0; c < columns;) {
        const int same = step(map_.value(r, c));
        Eigen::Index end = c + 1;
        while (end < columns && step(map_.value(r, end)) == same) ++end;
        out_ += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
            kLeft + w * static_cast<double>(c), kTop + kHeight - h * static_cast<double>(r + 1),
            w * static_cast<double>(end - c) + kSeam, h + kSeam,
            colour(scale(), static_cast<double>(same) / (kColours - 1)));
        c = end;
      }
    out_ += "</g>\n";
  }

  void lines() {
    if (map_.lines.empty()) return;
    out_ += "<g stroke=\"black\" stroke-width=\"0.8\">\n";
    for (const MapLine& line : map_.lines)
      out_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                          x(line.x0), y(line.y0), x(line.x1), y(line.y1));
    out_ += "</g>\n";
  }

  void axes() {
    out_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n",
        kLeft, kTop, kWidth, kHeight);
    for (int i = 0; i < kTicks; ++i) {
      const double share = static_cast<double>(i) / (kTicks - 1);
      const double at_x = map_.x_low + share * (map_.x_high - map_.x_low);
      const double at_y = map_.y_low + share * (map_.y_high - map_.y_low);
      label(x(at_x), kTop + kHeight + 18, "middle", whole(at_x));
      label(kLeft - 6, y(at_y) + 4, "end", whole(at_y));
    }
    label(kLeft + kWidth / 2, kTop + kHeight + 40, "middle", map_.x_title);
    label(kLeft - 54, kTop - 10, "start", map_.y_title);
  }

  void bar() {
    const double at = kLeft + kWidth + 20, h = kHeight / kColours;
    for (int i = 0; i < kColours; ++i)
      out_ +=
          fmt::format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                      at, kTop + kHeight - h * (i + 1), kBar, h + 0.5,
                      colour(scale(), static_cast<double>(i) / (kColours - 1)));
    for (int i = 0; i < kTicks; ++i) {
      const double share = static_cast<double>(i) / (kTicks - 1);
      label(at + kBar + 6, kTop + kHeight * (1.0 - share) + 4, "start",
            fmt::format("{:.2g}", low() + share * (map_.most - low())));
    }
    label(at, kTop - 10, "start", map_.value_title);
  }

  const HeatMap& map_;
  std::string out_;
};

}  // namespace

std::string svg(const HeatMap& map) { return HeatMapDrawing(map).text(); }

}  // namespace plumb::offline::show

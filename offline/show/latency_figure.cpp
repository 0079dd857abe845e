// SPDX-License-Identifier: Apache-2.0
#include "show/latency_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "show/duration.hpp"

namespace plumb::offline::show {
namespace {

using drivers::LatencyHistogram;

constexpr double kPlotLeft = 80, kPlotTop = 72, kPlotWidth = 600, kPlotHeight = 320,
                 kPlotRight = 40, kPlotAxis = 52, kPlotLine = 18;
constexpr double kFloor = 0.5;  // lowest count of the axis; below 1, so that one call is seen

struct Style {
  const char* colour;
  const char* fill;
  const char* dashes;
};
constexpr Style kStyles[] = {{"#054e8c", "#7caed6", "none"}, {"#9e4804", "none", "6 3"}};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

class HistogramDrawing {
 public:
  explicit HistogramDrawing(const LatencyFigure& figure) : figure_(figure) { find_ranges(); }

  std::string text() {
    const double height = kPlotTop + kPlotHeight + kPlotAxis + kPlotLine * (0.5 + lines());
    out_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        kPlotLeft + kPlotWidth + kPlotRight, height);
    label(kPlotLeft, 26, "start", figure_.title, "#000000", 15);
    axes();
    for (std::size_t i = 0; i < figure_.series.size(); ++i) draw(i);
    notes();
    return out_ + "</svg>\n";
  }

 private:
  double lines() const { return static_cast<double>(figure_.notes.size()); }

  /// Whole decades that hold every call.
  void find_ranges() {
    double fastest = 1e18, slowest = 1.0, most = 1.0;
    for (const auto& [name, histogram] : figure_.series)
      for (std::size_t i = 0; i < LatencyHistogram::kBins; ++i) {
        if (histogram.in_bin(i) == 0) continue;
        const auto low = static_cast<double>(LatencyHistogram::lower_ns(i));
        fastest = std::min(fastest, std::max(1.0, low));
        slowest = std::max(slowest, static_cast<double>(histogram.worst_ns()));
        most = std::max(most, static_cast<double>(histogram.in_bin(i)));
      }
    low_ = std::floor(std::log10(std::min(fastest, slowest)));
    high_ = std::max(low_ + 1.0, std::ceil(std::log10(1.05 * slowest)));
    most_ = std::max(1.0, std::ceil(std::log10(1.05 * most)));
  }

  double x(double ns) const {
    return kPlotLeft + kPlotWidth * (std::log10(std::max(1.0, ns)) - low_) / (high_ - low_);
  }
  double y(double count) const {
    const double foot = std::log10(kFloor);
    const double share = (std::log10(std::max(kFloor, count)) - foot) / (most_ - foot);
    return kPlotTop + kPlotHeight * (1.0 - share);
  }

  void label(double at_x, double at_y, const char* anchor, const std::string& text,
             const char* colour = "#000000", int size = 13) {
    out_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\">{}</text>"
        "\n",
        at_x, at_y, anchor, size, colour, escaped(text));
  }

  void line(double x0, double y0, double x1, double y1, const char* colour) {
    out_ += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x0, y0,
        x1, y1, colour);
  }

  void axes() {
    for (int decade = 0; low_ + decade <= high_; ++decade) {
      const double time = std::pow(10.0, low_ + decade), at = x(time);
      line(at, kPlotTop, at, kPlotTop + kPlotHeight, "#dddddd");
      label(at, kPlotTop + kPlotHeight + 18, "middle", duration(time));
    }
    for (int decade = 0; decade <= most_; ++decade) {
      const double calls = std::pow(10.0, decade), at = y(calls);
      line(kPlotLeft, at, kPlotLeft + kPlotWidth, at, "#dddddd");
      label(kPlotLeft - 6, at + 4, "end", fmt::format("{:.0f}", calls));
    }
    out_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n",
        kPlotLeft, kPlotTop, kPlotWidth, kPlotHeight);
    label(kPlotLeft + kPlotWidth / 2, kPlotTop + kPlotHeight + 40, "middle",
          "time a call [ns, us, ms; logarithmic]");
    label(kPlotLeft - 66, kPlotTop - 10, "start", "number of calls [logarithmic]");
  }

  /// The outline of the bins, which begins and ends at the bottom of the plot.
  std::string outline(const LatencyHistogram& histogram) const {
    std::string path = fmt::format("M{:.1f} {:.1f}", kPlotLeft, y(0.0));
    for (std::size_t i = 0; i + 1 < LatencyHistogram::kBins; ++i) {
      const auto from = static_cast<double>(LatencyHistogram::lower_ns(i));
      const auto to = static_cast<double>(LatencyHistogram::lower_ns(i + 1));
      if (x(from) < kPlotLeft || x(from) > kPlotLeft + kPlotWidth) continue;
      const auto count = static_cast<double>(histogram.in_bin(i));
      path += fmt::format("L{0:.1f} {1:.1f}L{2:.1f} {1:.1f}", x(from), y(count),
                          std::min(x(to), kPlotLeft + kPlotWidth));
    }
    return path + fmt::format("L{:.1f} {:.1f}", kPlotLeft + kPlotWidth, y(0.0));
  }

  void draw(std::size_t i) {
    const auto& [name, histogram] = figure_.series[i];
    const Style& style = kStyles[std::min(i, std::size(kStyles) - 1)];
    out_ += fmt::format(
        "<path d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.2\" stroke-dasharray=\"{}\"/>\n",
        outline(histogram), style.fill, style.colour, style.dashes);
    const auto worst = static_cast<double>(histogram.worst_ns());
    const double mark = kPlotTop + 16 + kPlotLine * static_cast<double>(i);
    line(x(worst), mark, x(worst), kPlotTop + kPlotHeight, style.colour);
    const bool right = x(worst) < kPlotLeft + 0.5 * kPlotWidth;
    label(x(worst) + (right ? 5 : -5), mark + 4, right ? "start" : "end",
          fmt::format("worst, {}: {}", name, duration(worst)), style.colour);
  }

  void notes() {
    double at = kPlotTop + kPlotHeight + kPlotAxis + kPlotLine;
    for (const auto& note : figure_.notes) {
      label(kPlotLeft, at, "start", note);
      at += kPlotLine;
    }
  }

  const LatencyFigure& figure_;
  double low_ = 0.0, high_ = 1.0;  // decades of time [ns]
  double most_ = 1.0;              // and of counts
  std::string out_;
};

}  // namespace

std::string svg(const LatencyFigure& figure) { return HistogramDrawing(figure).text(); }

}  // namespace plumb::offline::show

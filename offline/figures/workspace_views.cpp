// SPDX-License-Identifier: Apache-2.0
#include "figures/workspace_views.hpp"

#include <algorithm>

namespace plumb::offline::figures {
namespace {

constexpr double kMapHeight = 330.0, kWideMapHeight = 430.0, kWidePage = 1100.0,
                 kNarrowestMap = 250.0;
constexpr double kLeastSize_m = 0.1;
constexpr double kFlat = 0.06;  // of the largest size: a view along a plane shows a line
constexpr std::array<const char*, 3> kAxisNames{"x [mm]", "y [mm]", "z [mm]"};

}  // namespace

void Extent::add(const Eigen::Vector3d& p) {
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    low[at] = std::min(low[at], p(k)), high[at] = std::max(high[at], p(k));
  }
}

double Extent::middle(int axis) const {
  const auto k = static_cast<std::size_t>(axis);
  return high[k] >= low[k] ? 0.5 * (low[k] + high[k]) : 0.0;
}

double Extent::size(int axis) const {
  const auto k = static_cast<std::size_t>(axis);
  return high[k] > low[k] ? high[k] - low[k] : kLeastSize_m;
}

WorkspaceViews::WorkspaceViews(double page_width, const Extent& extent, double margin_px)
    : width_(page_width), extent_(extent) {
  const double largest = std::max({extent.size(0), extent.size(1), extent.size(2)});
  for (const View& view : kViews)
    if (std::min(extent.size(view.across), extent.size(view.up)) > kFlat * largest)
      views_.push_back(view);
  if (views_.empty()) views_.assign(kViews.begin(), kViews.end());
  draw::Sheet trial(width_, {.title = "", .sentence = ""});
  const draw::Axis widest{.title = "x", .low = -8888.0, .high = 8888.0};
  plot_ = draw::Panel(trial.svg(), rooms(trial).front(), widest, widest, "view").plot();
  px_ = INFINITY;
  for (const View& view : views_) {
    px_ = std::min(px_, (plot_.width() - 2.0 * margin_px) / extent.size(view.across));
    px_ = std::min(px_, (plot_.height() - 2.0 * margin_px) / extent.size(view.up));
  }
}

std::vector<draw::Box> WorkspaceViews::rooms(draw::Sheet& sheet) const {
  return sheet.grid(static_cast<int>(views_.size()), kNarrowestMap,
                    width_ >= kWidePage ? kWideMapHeight : kMapHeight);
}

std::array<draw::Axis, 2> WorkspaceViews::axes(const View& view, const draw::Box& plot) const {
  std::array<draw::Axis, 2> out;
  const std::array<int, 2> which{view.across, view.up};
  const std::array<double, 2> room{plot.width(), plot.height()};
  for (std::size_t k = 0; k < 2; ++k) {
    const double middle = extent_.middle(which[k]), half = 0.5 * room[k] / px_;
    out[k] = {.title = kAxisNames[static_cast<std::size_t>(which[k])],
              .low = 1e3 * (middle - half),
              .high = 1e3 * (middle + half),
              .ends = draw::Axis::Ends::kExact};
  }
  return out;
}

std::vector<draw::Panel> WorkspaceViews::panels(draw::Sheet& sheet) const {
  std::vector<draw::Panel> out;
  const auto boxes = rooms(sheet);
  for (std::size_t k = 0; k < views_.size(); ++k) {
    // The labels of the ticks decide how much room a frame has; the second time they are known.
    draw::Box inner = plot_;
    for (int again = 0; again < 2; ++again) {
      draw::Svg unused(width_);
      const auto trial = axes(views_[k], inner);
      inner = draw::Panel(unused, boxes[k], trial[0], trial[1], views_[k].name).plot();
    }
    const auto final = axes(views_[k], inner);
    out.emplace_back(sheet.svg(), boxes[k], final[0], final[1], views_[k].name);
  }
  return out;
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"

namespace plumb::offline::figures {

/// One direction from which the workspace is seen: the axes of the base frame across and up.
struct View {
  const char* name;
  int across, up;
};
inline constexpr std::array<View, 3> kViews{
    {{"from above", 0, 1}, {"from the side", 0, 2}, {"from the front", 1, 2}}};

/// The box of some points of the base frame [m].
struct Extent {
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY};
  std::array<double, 3> high{-INFINITY, -INFINITY, -INFINITY};
  void add(const Eigen::Vector3d& p);
  double middle(int axis) const;
  double size(int axis) const;  // > 0
};

/// Room for the views side by side or below each other, in which a metre has the same number of
/// pixels in all directions. All three of kViews, or that of the plane in which the points lie.
class WorkspaceViews {
 public:
  /// `margin_px`: left free around the points, for arrows and signs.
  WorkspaceViews(double page_width, const Extent& extent, double margin_px);

  double px_per_m() const { return px_; }

  const std::vector<View>& views() const { return views_; }

  /// The panels, in the order of `views`; axes in [mm].
  std::vector<draw::Panel> panels(draw::Sheet& sheet) const;

 private:
  std::vector<draw::Box> rooms(draw::Sheet& sheet) const;
  std::array<draw::Axis, 2> axes(const View& view, const draw::Box& plot) const;

  double width_;
  Extent extent_;
  std::vector<View> views_;
  draw::Box plot_;  // of a frame with the widest labels
  double px_ = 1.0;
};

}  // namespace plumb::offline::figures

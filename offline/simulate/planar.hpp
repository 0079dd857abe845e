// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// The flexible planar two-link mechanism of the published study.
namespace plumb::offline {

/// kPublished reproduces the published figures (bars of 100 mm, loads of link 3 turned with phi23
/// only). kPrinted has the printed dimensions (60 mm) and correct statics.
enum class PlanarVariant { kPublished, kPrinted };

inline constexpr double kPlanarLink_m = 1.0;
inline constexpr double kPlanarOriginY_m = 2.0;  // point A at (0, 2 m)

/// Flexible minus rigid position of point C [m] at joint angles [rad].
Eigen::Vector2d planar_deflection(PlanarVariant variant, double phi12, double phi23);

/// The grid of joint angles -pi/2 : step : pi/2 by -3 pi/4 : step : 3 pi/4 [rad], shape (n, 2). The
/// upper limits are not on the grid. Steps 0.1, 0.05 and 0.01 give the 1536, 5985 and 148,680 poses
/// of the study.
RowsN planar_grid(double step);

/// The planar arm as a cell: two standard DH rows, frame and target given, gravity along -y.
Cell planar_cell(PlanarVariant variant);

}  // namespace plumb::offline

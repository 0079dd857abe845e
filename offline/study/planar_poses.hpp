// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "simulate/planar.hpp"
#include "tree/samples.hpp"

namespace plumb::offline::study {

/// Joint angles of the planar arm [rad] and the position of its point C in the frame of point A
/// [m].
struct PlanarPoses {
  RowsN q;         // (n, 2)
  Samples p_AC_A;  // (n, 2)
};

/// Steps of the three grids of the study [rad]: 1536, 5985 and 148,680 poses.
inline constexpr double kTrainingStep = 0.1, kTestStep = 0.05, kFineStep = 0.01;

/// The true positions of the flexible arm.
PlanarPoses true_poses(PlanarVariant variant, const RowsN& q);

/// The same with white noise of sigma_m per axis. Deterministic in the seed.
PlanarPoses measured_poses(PlanarVariant variant, const RowsN& q, double sigma_m,
                           std::uint64_t seed);

/// Uniformly distributed random angles inside the box of `around`, none of them on its grid. Shape
/// (n, 2).
RowsN random_angles(const RowsN& around, int n, std::uint64_t seed);

/// Mean and largest total error e_t = sqrt(dx^2 + dy^2) of the study, eq. (20) [m].
struct TotalError {
  double mean = 0.0, max = 0.0;
};
TotalError total_error(const Samples& predicted, const Samples& truth);

}  // namespace plumb::offline::study

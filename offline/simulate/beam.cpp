// SPDX-License-Identifier: Apache-2.0
#include "simulate/beam.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace plumb::offline::sim {
namespace {

constexpr int kIntervals = 128;  // even

// Ratio of the weight per length at x to that at the root.
double section(const TaperedBeam& beam, double x) { return std::pow(1.0 - beam.taper * x, 2); }

// Integral of section(y) (y - x) over y = x .. 1; one Simpson interval is exact for a cubic.
double outboard_moment(const TaperedBeam& beam, double x) {
  const double span = 1.0 - x;
  const double middle = section(beam, x + 0.5 * span) * 0.5 * span;
  const double end = section(beam, 1.0) * span;
  return span / 6.0 * (4.0 * middle + end);
}

}  // namespace

BeamEnd bend(const TaperedBeam& beam, const Eigen::Vector3d& along, const Eigen::Vector3d& force,
             const Eigen::Vector3d& moment, const Eigen::Vector3d& gravity) {
  // Curvature at s: k = M_across / EI + M_along / GJ, M = M_end + (L - s) u x F + u x (own weight).
  // End: rotation = int k ds, displacement = int k x u (L - s) ds.
  const double L = beam.length;
  const double share = 1.0 - beam.taper + beam.taper * beam.taper / 3.0;  // int section dx
  const Eigen::Vector3d weight = beam.mass / share * gravity;
  BeamEnd end{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int k = 0; k <= kIntervals; ++k) {
    const double x = static_cast<double>(k) / kIntervals;
    const double simpson = (k == 0 || k == kIntervals) ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    const double ds = simpson * L / (3.0 * kIntervals);
    const Eigen::Vector3d lever_load =
        (1.0 - x) * L * force + outboard_moment(beam, x) * L * weight;
    const Eigen::Vector3d M = moment + along.cross(lever_load);
    const Eigen::Vector3d M_along = along.dot(M) * along;
    const double EI = beam.EI * std::pow(1.0 - beam.taper * x, 4);
    const Eigen::Vector3d curvature = (M - M_along) / EI + M_along / (EI * beam.GJ_over_EI);
    end.rotation += ds * curvature;
    end.displacement += ds * (1.0 - x) * L * curvature.cross(along);
  }
  return end;
}

}  // namespace plumb::offline::sim

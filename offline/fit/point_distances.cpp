// SPDX-License-Identifier: Apache-2.0
#include "fit/point_distances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/artefacts.hpp"
#include "fit/constants.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline {
namespace {

/// Index of the x of a point among the estimates; those of y and z follow. -1 if it is not fitted.
Eigen::Index index_of(const MeasurementSettings& settings, const Calibration& c, int setup) {
  const std::string name = artefact_prefix(settings, setup) + "x";
  for (std::size_t i = 0; i < c.estimates.size(); ++i)
    if (c.estimates[i].name == name) return static_cast<Eigen::Index>(i);
  return -1;
}

bool is_point(const Setup& setup) { return setup.reads == ReadingKind::kPoint; }

}  // namespace

Vector3 touched_point_B(const Calibration& c, int setup) {
  return -from_pose(c.state.frame(setup)).p;
}

PointDistance point_distance(const MeasurementSettings& settings, const Calibration& c, int from,
                             int to) {
  PointDistance out;
  out.from = from;
  out.to = to;
  const Vector3 apart = touched_point_B(c, from) - touched_point_B(c, to);
  out.length_m = apart.norm();
  const Eigen::Index a = index_of(settings, c, from), b = index_of(settings, c, to);
  if (a < 0 || b < 0 || out.length_m == 0.0 || c.covariance.rows() < std::max(a, b) + 3) return out;
  Eigen::VectorXd along = Eigen::VectorXd::Zero(c.covariance.rows());
  along.segment<3>(a) = apart / out.length_m;
  along.segment<3>(b) = -apart / out.length_m;
  out.half_m = kNormal95 * std::sqrt(std::max(0.0, along.dot(c.covariance * along)));
  return out;
}

std::vector<PointDistance> point_distances(const MeasurementSettings& m, const Calibration& c) {
  std::vector<PointDistance> out;
  for (const KnownLength& known : m.lengths) {
    PointDistance one = point_distance(m, c, known.from, known.to);
    one.stated_m = known.length_m;
    out.push_back(one);
  }
  const auto listed = [&](int a, int b) {
    return std::any_of(out.begin(), out.end(), [&](const PointDistance& d) {
      return std::minmax(d.from, d.to) == std::minmax(a, b);
    });
  };
  const auto count = static_cast<int>(m.setups.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      const Setup &from = m.setups[static_cast<std::size_t>(a)],
                  &to = m.setups[static_cast<std::size_t>(b)];
      if (is_point(from) && is_point(to) && !from.position.empty() &&
          from.position == to.position && !listed(a, b))
        out.push_back(point_distance(m, c, a, b));
    }
  return out;
}

std::string distance_words(const MeasurementSettings& m, const PointDistance& d) {
  const auto name = [&](int k) { return m.setups[static_cast<std::size_t>(k)].name; };
  std::string out =
      fmt::format("'{}' and '{}' are {:.3f} mm apart", name(d.from), name(d.to), d.length_m * 1e3);
  if (d.half_m > 0.0) out += fmt::format(", give or take {:.3f} mm", d.half_m * 1e3);
  if (d.stated_m) out += fmt::format(" (stated: {:g} mm)", *d.stated_m * 1e3);
  return out;
}

}  // namespace plumb::offline

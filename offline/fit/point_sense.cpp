// SPDX-License-Identifier: Apache-2.0
#include "fit/point_sense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "arm/predicted_points.hpp"
#include "cell/artefacts.hpp"
#include "fit/constants.hpp"
#include "fit/point_distances.hpp"
#include "numbers/tails.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

std::string name_of(const MeasurementSettings& m, int setup) {
  return m.setups[static_cast<std::size_t>(setup)].name;
}

/// W-FIT-PLACES: with fewer placements no whole one is held out.
void find_few_placements(const Measurements& fitted, std::vector<Problem>& out) {
  std::set<int> placements;
  for (int i = 0; i < fitted.size(); ++i) {
    if (!fitted.of_artefact(i)) return;
    placements.insert(fitted.placement[static_cast<std::size_t>(i)]);
  }
  if (placements.size() >= static_cast<std::size_t>(kFewestPlacements)) return;
  out.push_back({.severity = Severity::kWarning,
                 .code = "W-FIT-PLACES",
                 .message = fmt::format(
                     "all readings are of {}: the held-out error is that there, "
                     "and says little of other places",
                     counted_words(static_cast<long long>(placements.size()), "place", "places")),
                 .help = "measure at four places or more, high and low, near and far"});
}

void find_contradicted(const MeasurementSettings& m, const Calibration& c,
                       std::vector<Problem>& out) {
  for (const PointDistance& d : point_distances(m, c)) {
    const double sigma = std::hypot(m.sigma_length_m, d.half_m / kNormal95);
    if (!d.stated_m || std::abs(d.length_m - *d.stated_m) <= kSureBeyond_sigma * sigma) continue;
    out.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FIT-LENGTH",
         .message = "a known distance contradicts the other readings: " + distance_words(m, d),
         .help = "measure it again, check its unit, or take it out of column 'distance_mm'"});
  }
}

void find_same(const MeasurementSettings& m, const Calibration& c, const std::vector<int>& touched,
               std::vector<Problem>& out) {
  for (std::size_t a = 0; a < touched.size(); ++a)
    for (std::size_t b = a + 1; b < touched.size(); ++b)
      if (point_distance(m, c, touched[a], touched[b]).length_m < kSamePoint_m)
        out.push_back(
            {.severity = Severity::kWarning,
             .code = "W-FIT-POINT-SAME",
             .message = fmt::format("'{}' and '{}' are one point by what the arm reads there",
                                    name_of(m, touched[a]), name_of(m, touched[b])),
             .help = "give their rows one label, if it is one socket that stood still"});
}

Eigen::RowVector3d mean_of(const Rows3& left, Eigen::Index first, Eigen::Index last) {
  return left.middleRows(first, last - first).colwise().mean();
}

/// Where the residuals of one point change, and by how much.
struct Cut {
  Eigen::Index first = 0;  // of the later readings
  double moved_m = 0.0;
  double sigma_m = 0.0;     // of one reading about the two means
  double deviations = 0.0;  // moved_m in standard deviations of the difference of the means

  bool clear() const { return deviations > kPointMoved && moved_m > kPointMovedBeside * sigma_m; }
};

/// The clearest place to cut. A model that lacks an effect leaves residuals that change slowly
/// while the arm turns about the point, so that the readings next to the cut must show the change
/// as well.
Cut best_cut(const Rows3& left, int axes) {
  Cut best;
  const Eigen::Index n = left.rows(), beside = kTouchesBeside;
  for (Eigen::Index k = beside; k + beside <= n; ++k) {
    const Eigen::RowVector3d before = mean_of(left, 0, k), after = mean_of(left, k, n);
    const double squares = (left.topRows(k).rowwise() - before).squaredNorm() +
                           (left.bottomRows(n - k).rowwise() - after).squaredNorm();
    Cut cut{.first = k, .moved_m = (after - before).norm()};
    const double there = (mean_of(left, k, k + beside) - mean_of(left, k - beside, k)).norm();
    if (there < kMovedAtOnce * cut.moved_m) continue;
    cut.sigma_m = std::sqrt(squares / (axes * static_cast<double>(n - 2)));
    cut.deviations =
        cut.moved_m /
        (cut.sigma_m * std::sqrt(1.0 / static_cast<double>(k) + 1.0 / static_cast<double>(n - k)));
    if (cut.deviations > best.deviations) best = cut;
  }
  return best;
}

void find_moved(const MeasurementSettings& m, const Measurements& fitted, const Calibration& c,
                const std::map<int, std::vector<int>>& rows, std::vector<Problem>& out) {
  for (const auto& [setup, of_point] : rows) {
    const Measurements some = pick(fitted, of_point);
    const Cut cut = best_cut(residuals(some, predict_points(c.state, some)), some.usual_axes());
    if (!cut.clear()) continue;
    const std::string& pose = some.pose[static_cast<std::size_t>(cut.first)];
    out.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FIT-POINT-MOVED",
         .message = fmt::format("from pose {} on, the tool meets '{}' {:.3f} mm away from "
                                "where it was before",
                                pose, name_of(m, setup), cut.moved_m * 1e3),
         .help = "if it was moved there, give the later rows another label"});
  }
}

}  // namespace

std::vector<Problem> point_remarks(const MeasurementSettings& settings, const Measurements& fitted,
                                   const Calibration& calibration) {
  std::vector<Problem> out;
  std::map<int, std::vector<int>> rows;
  for (int i = 0; i < fitted.size(); ++i)
    if (fitted.of_artefact(i)) rows[setup_of(fitted, i)].push_back(i);
  std::vector<int> touched;
  for (const auto& [setup, of_one] : rows)
    if (settings.setups[static_cast<std::size_t>(setup)].reads == ReadingKind::kPoint)
      touched.push_back(setup);
  find_few_placements(fitted, out);
  find_contradicted(settings, calibration, out);
  find_same(settings, calibration, touched, out);
  find_moved(settings, fitted, calibration, rows, out);
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "check/convention_candidate.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "arm/parameter.hpp"
#include "check/constants.hpp"
#include "check/unit_guess.hpp"

namespace plumb::offline {

CandidateFitter::CandidateFitter(const Cell& cell, const Measurements& some,
                                 const Convention& labels, InterpretedCells& cells)
    : cell_(cell),
      some_(some),
      labels_(labels),
      cells_(cells),
      rows_(static_cast<std::size_t>(some.size())) {
  std::iota(rows_.begin(), rows_.end(), 0);
}

ConventionCandidate CandidateFitter::placed(const Convention& c, Eigen::Matrix3d M,
                                            const Eigen::Vector3d& target_T) {
  const Cell& cell = cells_.as(c);
  const Measurements some = read_as(some_, cell_, labels_, c);
  if (c.mirror != Mirror::kNone) M.col(1) *= -1.0;  // as kNegateY does to the points
  ConventionCandidate out;
  out.placed = robust_placement(cell, some, rows_, state_near(cell, some, rows_, M, target_T));
  out.interpretation = {
      .convention = c,
      .changes = changes(labels_, c),
      .placed_m = out.placed.rms_m,
      .fitted_m = out.placed.rms_m,
      .size_m = std::sqrt((some.p_M.rowwise() - some.p_M.colwise().mean().eval()).squaredNorm() /
                          static_cast<double>(some.size()))};
  return out;
}

ConventionCandidate CandidateFitter::placed(const ConventionLead& lead, bool mirrored) {
  Convention c = lead.convention;
  const auto units = explain_ratios({labels_.length_unit, labels_.slide_unit, labels_.point_unit},
                                    lead.loose.ratio, lead.slide_ratio, reach(cell_.nominal));
  c.length_unit = units.table;
  c.slide_unit = units.slide;
  c.point_unit = units.point;
  if (mirrored) c.mirror = Mirror::kNegateY;
  const double shorter = unit_ratio(units.table, labels_.length_unit);
  return placed(c, lead.loose.M, lead.loose.target_T * shorter);
}

/// Points on one circle or in one plane leave the linear placement undetermined, and so the start
/// of frame and target. Then the start that `fit` itself would use is taken if it is better.
ConventionCandidate CandidateFitter::as_labelled(const LinearPlacement& loose) {
  ConventionCandidate out = placed(labels_, loose.M, loose.target_T);
  if (out.interpretation.placed_share() <= check::kFits) return out;
  RegularisedFit other = placed_from_the_labels(cell_, some_, rows_);
  if (!(other.rms_m < out.placed.rms_m)) return out;
  out.interpretation.placed_m = out.interpretation.fitted_m = other.rms_m;
  out.placed = std::move(other);
  return out;
}

void CandidateFitter::fit(ConventionCandidate& candidate) {
  const Convention& c = candidate.interpretation.convention;
  const Measurements some = read_as(some_, cell_, labels_, c);
  candidate.interpretation.fitted_m =
      regularised_fit(cells_.as(c), some, rows_, candidate.placed.state).rms_m;
}

}  // namespace plumb::offline

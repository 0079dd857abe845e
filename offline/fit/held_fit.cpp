// SPDX-License-Identifier: Apache-2.0
#include "fit/held_fit.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "arm/predicted_points.hpp"
#include "fit/constants.hpp"
#include "fit/fit_judgement.hpp"
#include "program/problem.hpp"
#include "solve/series_solver.hpp"

namespace plumb::offline {
namespace {

bool is_lost(const Failure& failure) {
  const std::string& code = failure.problems().front().code;
  return code == "E-FIT-CONVERGE" || code == "E-FIT-FAR";
}

double rms_m(const FitData& data, const ArmState& state) {
  const Measurements some = pick(*data.measured, data.rows);
  return std::sqrt(residuals(some, predict_points(state, some)).squaredNorm() /
                   static_cast<double>(data.rows.size()));
}

/// A calibration, or why it is lost: it does not converge, or not to this arm.
struct Attempt {
  std::optional<Calibration> ended;
  std::optional<Failure> lost;
};

Attempt attempt(const HeldFit& fit, HeldNear held) {
  Attempt out;
  try {
    out.ended = fit(held);
    check_same_arm(out.ended->estimates);
  } catch (const Failure& failure) {
    if (!is_lost(failure)) throw;
    out.lost = failure;
  }
  return out;
}

/// Along a line or a curve, numbers of the arm may wander far off together with a series of waves.
bool may_have_wandered(const Attempt& fit) {
  return fit.lost || (has_series(fit.ended->state) && ends_far(fit.ended->estimates));
}

/// Whether a fit with all numbers held counts instead of one that may have wandered: it must stay
/// near nominal, and explain the readings as well. An arm that is another one than its cell says
/// stays another one.
bool counts_instead(const Attempt& near, const Attempt& wandered, const FitData& data) {
  if (near.lost || (!wandered.lost && ends_far(near.ended->estimates))) return false;
  return !wandered.ended ||
         rms_m(data, near.ended->state) <
             (wandered.lost ? kNearlyAsGood : kAsGood) * rms_m(data, wandered.ended->state);
}

}  // namespace

Calibration held_if_it_wanders(const FitData& data, const HeldFit& fit) {
  Attempt found = attempt(fit, HeldNear::kWeakDirections);
  if (!may_have_wandered(found)) return std::move(*found.ended);
  try {
    Attempt near = attempt(fit, HeldNear::kAllDirections);
    if (counts_instead(near, found, data)) return std::move(*near.ended);
  } catch (const Failure& failure) {
    if (failure.exit_code() != Exit::kNumbersSayNo) throw;
  }
  if (found.lost) throw Failure(std::move(*found.lost));
  return std::move(*found.ended);
}

Calibration held_if_it_is_lost(const HeldFit& fit) {
  try {
    return fit(HeldNear::kWeakDirections);
  } catch (const Failure& failure) {
    if (!is_lost(failure)) throw;
  }
  return fit(HeldNear::kAllDirections);
}

}  // namespace plumb::offline

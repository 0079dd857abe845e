// SPDX-License-Identifier: Apache-2.0
#include "compare/full_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "arm/predicted_points.hpp"
#include "compare/constants.hpp"
#include "compare/joint_shares.hpp"
#include "fit/verdict.hpp"
#include "noise/repeatability.hpp"
#include "noise/series.hpp"
#include "noise/step_motions.hpp"

namespace plumb::offline::compare {
namespace {

/// Whether a function of one joint's angle explains a clear part of the error. Scatter hardly does.
bool depends_on_a_joint(const Measurements& measured, const Fit& fit,
                        const std::vector<int>& rows) {
  const Rows3 error_M = residuals(measured, fit.predicted_M);
  const StepMotions motions(fit.calibration.state, measured, series(measured, error_M, rows));
  const auto shares = joint_shares(motions, measured.q);
  return std::any_of(shares.begin(), shares.end(),
                     [](const auto& s) { return s.matters && s.share > kClearJointShare; });
}

}  // namespace

std::string full_verdict(const Cell& cell, const Measurements& measured, const Fit& fit) {
  const std::string out = verdict(fit, cell.tolerance_m);
  const auto excess = held_out_excess_of(fit);
  // A run of another cell file than the present one does not know its parameters.
  const bool known = !fit.calibration.parameters.empty();
  if (!excess || !excess->lack_of_fit() || fit.floor.inferred_m > 0.0 || !known) return out;
  const auto rows = without_outliers(
      without_outliers(fit_rows(fit.split), fit.calibration.outliers), fit.held_outliers);
  const Repeatability scatter =
      repeatability(cell, measured, fit.calibration.state, fit.calibration.parameters, rows);
  if (!scatter.supported() || depends_on_a_joint(measured, fit, rows)) return out;
  return fmt::format(
      "{} That, or the joints do not come back to the same place ({}); plumb diagnose tells which.",
      out, in_words(cell, scatter));
}

}  // namespace plumb::offline::compare

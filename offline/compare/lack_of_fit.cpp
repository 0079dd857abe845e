// SPDX-License-Identifier: Apache-2.0
#include "compare/lack_of_fit.hpp"

#include <algorithm>

#include "cell/group_rows.hpp"
#include "compare/constants.hpp"
#include "noise/repeat_groups.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline::compare {
namespace {

/// Sums of squares of the means of groups of repeats and within the groups.
struct GroupSquares {
  double model = 0.0, pure = 0.0;
  int groups = 0, repeats = 0;  // repeats: readings beyond the first of each group
};

GroupSquares squares_of(const Measurements& measured, const Rows3& error,
                        const std::vector<int>& rows) {
  GroupSquares out;
  visit_groups(repeat_groups(measured), rows, [&](std::span<const int> members) {
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    const auto n = static_cast<double>(members.size());
    for (const int i : members) mean += error.row(i) / n;
    for (const int i : members) out.pure += (error.row(i) - mean).squaredNorm();
    out.model += n * mean.squaredNorm();
    ++out.groups;
    out.repeats += static_cast<int>(members.size()) - 1;
  });
  return out;
}

}  // namespace

bool LackOfFit::significant() const { return basis != Basis::kNone && ln_p < kLackOfFit_ln_p; }

LackOfFit lack_of_fit(const Measurements& measured, const Rows3& fit_error_M,
                      const std::vector<int>& rows, int parameters, const NoiseFloor& floor) {
  using Basis = LackOfFit::Basis;
  LackOfFit out;
  const int axes = measured.usual_axes();
  const GroupSquares s = squares_of(measured, fit_error_M, rows);
  const bool repeated = s.repeats >= kEnoughRepeats && s.pure > 0.0;
  if (!repeated && !(floor.sigma_m > 0.0)) return out;
  out.dof_model = axes * (repeated ? s.groups : s.groups + s.repeats) - parameters;
  if (out.dof_model <= 0) return out;
  out.dof_noise = repeated ? axes * s.repeats : 0;
  const double squares = repeated ? s.model : s.model + s.pure;
  const double noise = repeated ? s.pure / out.dof_noise : floor.sigma_m * floor.sigma_m;
  out.basis = repeated ? Basis::kRepeats : Basis::kSigma;
  out.ratio = squares / out.dof_model / noise;
  out.ln_p = ln_f_tail(out.ratio, out.dof_model, repeated ? out.dof_noise : kKnownExactly);
  const double all = (s.model + s.pure) / (axes * (s.groups + s.repeats) - parameters);
  out.systematic = std::max(0.0, 1.0 - noise / all);
  return out;
}

}  // namespace plumb::offline::compare

// SPDX-License-Identifier: Apache-2.0
#include "compare/comparison.hpp"

#include <algorithm>
#include <utility>

#include "arm/joint_turns.hpp"
#include "arm/predicted_points.hpp"
#include "cell/group_rows.hpp"
#include "compare/profiles.hpp"
#include "noise/step_motions.hpp"

namespace plumb::offline::compare {
namespace {

/// Errors at all poses: out of fold where a pose was held out, and those of the final model.
struct Errors {
  Rows3 judged_M;  // out of fold where held out
  Rows3 final_M;
  std::vector<int> held, fit, used;
};

Errors errors_of(const Measurements& measured, const Fit& fit) {
  Errors out;
  out.judged_M = residuals(measured, fit.predicted_M);
  out.final_M = residuals(measured, predict_points(fit.calibration.state, measured));
  out.held = held_rows(fit.split);
  out.fit = fit_rows(fit.split);
  for (int i = 0; i < measured.size(); ++i)
    if (fit.split.used[i]) out.used.push_back(i);
  return out;
}

double share_within(const Rows3& error, const std::vector<int>& rows, double tolerance_m) {
  if (rows.empty()) return 0.0;
  const auto within = std::count_if(rows.begin(), rows.end(),
                                    [&](int i) { return error.row(i).norm() <= tolerance_m; });
  return static_cast<double>(within) / static_cast<double>(rows.size());
}

/// judged, final: how far each row is missed, out of fold where it was held out, and by the final
/// model. `errors` must live longer.
SamplesOf samples_of(const Measurements& measured, const Errors& errors, Comparison::Set set,
                     Eigen::VectorXd judged_size, Eigen::VectorXd final_size) {
  using Which = Sample::Set;
  std::vector<bool> fitted(static_cast<std::size_t>(measured.size()), false), judged = fitted;
  for (const int i : errors.fit) fitted[static_cast<std::size_t>(i)] = true;
  for (const int i : set == Comparison::Set::kHeldOut ? errors.held : errors.fit)
    judged[static_cast<std::size_t>(i)] = true;
  std::vector<bool> repeat, seen(count_groups(measured.replicate_group), false);
  for (const int i : errors.used) {
    const auto group = static_cast<std::size_t>(measured.replicate_group[i]);
    repeat.push_back(seen[group]);
    seen[group] = true;
  }
  return [&errors, fitted, judged, repeat, judged_size = std::move(judged_size),
          final_size = std::move(final_size)](const std::function<double(int)>& value) {
    std::vector<Sample> out;
    out.reserve(errors.used.size());
    for (const int i : errors.used) {
      const auto k = static_cast<std::size_t>(i);
      out.push_back({.value = value(i),
                     .error = judged_size(i),
                     .set = !judged[k]  ? Which::kFitted
                            : fitted[k] ? Which::kBoth
                                        : Which::kJudged,
                     .fit_error = final_size(i),
                     .repeat = repeat[out.size()]});
    }
    return out;
  };
}

int fitted_numbers(const Fit& fit) {
  auto out = static_cast<int>(fit.calibration.estimates.size());
  for (const auto& tree : fit.calibration.state.arm.trees)
    out += static_cast<int>(tree.coefficients.size());
  return out;
}

Turns turns_of(const Cell& cell, const Measurements& measured, const Fit& fit, const Errors& errors,
               Comparison::Set set) {
  Turns out;
  if (fit.turned_G.size() == 0 || !measured.has_orientation()) return out;
  const ArmState& state = fit.calibration.state;
  const Eigen::VectorXd size = fit.turned_G.rowwise().norm();
  for (const int i : set == Comparison::Set::kHeldOut ? errors.held : errors.fit)
    out.poses.push_back({i, measured.pose[static_cast<std::size_t>(i)], size(i)});
  std::stable_sort(out.poses.begin(), out.poses.end(),
                   [](const auto& a, const auto& b) { return a.error_rad > b.error_rad; });
  out.profiles = profiles(cell, measured, state,
                          samples_of(measured, errors, set, size, turn_errors(state, measured)));
  const RowsN about = turns_about_joints(state, measured, fit.turned_G);
  out.joints = turn_shares(about, fit.turned_G, measured.q, errors.used);
  out.axis = main_axis(about, fit.turned_G, errors.used);
  return out;
}

}  // namespace

Comparison comparison(const Cell& cell, const Measurements& measured, const Fit& fit) {
  Errors errors = errors_of(measured, fit);
  Comparison out;
  out.set = fit.held.n > 0 ? Comparison::Set::kHeldOut : Comparison::Set::kFit;
  const bool held = out.set == Comparison::Set::kHeldOut;
  const auto& rows = held ? errors.held : errors.fit;
  std::vector<double> norms;
  for (const int i : rows) {
    out.poses.push_back(
        {.row = i, .pose = measured.pose[i], .error_M = errors.judged_M.row(i), .held = held});
    norms.push_back(errors.judged_M.row(i).norm());
  }
  out.stats = summarise(std::move(norms));
  out.within_tolerance = share_within(errors.judged_M, rows, cell.tolerance_m);
  out.fit_within_tolerance = share_within(errors.final_M, errors.fit, cell.tolerance_m);
  std::stable_sort(out.poses.begin(), out.poses.end(), [](const auto& a, const auto& b) {
    return a.error_M.norm() > b.error_M.norm();
  });
  const ArmState& state = fit.calibration.state;
  out.profiles = profiles(cell, measured, state,
                          samples_of(measured, errors, out.set, errors.judged_M.rowwise().norm(),
                                     errors.final_M.rowwise().norm()));
  out.turns = turns_of(cell, measured, fit, errors, out.set);
  // Without gross outliers, which would look like a jump.
  const auto alike = [&](const std::vector<int>& all) {
    return without_outliers(without_outliers(all, fit.calibration.outliers), fit.held_outliers);
  };
  out.lack_of_fit =
      lack_of_fit(measured, errors.final_M, alike(errors.fit), fitted_numbers(fit), fit.floor);
  Series in_order = series(measured, errors.judged_M, alike(errors.used));
  errors = {};  // frees a tenth of the memory that a million poses take
  out.order = autocorrelation(in_order, measured.q);
  const StepMotions motions(state, measured, std::move(in_order));
  out.joints = joint_shares(motions, measured.q);
  out.changes = change_points(motions);
  return out;
}

}  // namespace plumb::offline::compare

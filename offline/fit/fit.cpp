// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/arm_state.hpp"
#include "tree/domain.hpp"

namespace plumb::offline {
namespace {

constexpr double kFarTimes = 6.0;              // the usual scatter: an outlier
constexpr double kSmallestScatter_m = 0.1e-6;  // of noise-free data
constexpr std::size_t kListed = 5;
constexpr double kStill = 1e-3;  // [rad] or [m]

const EffectEntry* find_effect(const Cell& cell, std::string_view name) {
  const auto it = std::find_if(cell.effects.begin(), cell.effects.end(),
                               [&](const EffectEntry& e) { return e.name == name; });
  return it == cell.effects.end() ? nullptr : &*it;
}

/// "2%" or 0.02.
double share_of(const EffectEntry::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* text = std::get_if<std::string>(&value)) return std::stod(*text) / 100.0;
  return 0.02;
}

TreeSettings tree_settings(const Cell& cell, const EffectEntry& entry) {
  TreeSettings out;
  out.seed = cell.measurement.seed;
  if (const auto it = entry.options.find("min_gain"); it != entry.options.end())
    out.min_gain = share_of(it->second);
  const auto says = [&](const char* key, const char* word) {
    const auto it = entry.options.find(key);
    return it != entry.options.end() && it->second == EffectEntry::Value(std::string(word));
  };
  if (says("form", "crisp")) out.form = TreeForm::kCrisp;
  if (says("form", "blended")) out.form = TreeForm::kBlended;
  if (says("splits", "own")) out.sharing = Sharing::kOwn;
  if (const auto it = entry.options.find("degree"); it != entry.options.end())
    out.max_degree = static_cast<int>(std::get<double>(it->second));
  return out;
}

struct Fitted {
  Calibration calibration;
  std::optional<TreeChoice> tree;
  ArmState geometry_only;
};

Fitted fit_on(const Cell& cell, const Measurements& measured, const std::vector<int>& rows) {
  Fitted out;
  out.calibration = calibrate(cell, measured, rows);
  const Measurements some = pick(measured, without_outliers(rows, out.calibration.outliers));
  out.calibration.state.arm.domain = trained_box(some.q);
  out.geometry_only = out.calibration.state;
  const EffectEntry* entry = find_effect(cell, "local_tree");
  if (entry == nullptr) return out;
  const ArmState& state = out.geometry_only;
  const Rows3 error_B = to_base(state, residuals(some, predict_points(state, some)));
  out.tree = choose_trees(some.q, error_B, some.has_axis, some.replicate_group,
                          tree_settings(cell, *entry));
  out.calibration.state.arm.trees = out.tree->trees;
  out.calibration.state.arm.domain = out.tree->domain;
  return out;
}

void overwrite(Rows3& all, const std::vector<int>& rows, const Rows3& with) {
  for (std::size_t i = 0; i < rows.size(); ++i) all.row(rows[i]) = with.row(i);
}

Rows3 predicted_at(const ArmState& state, const Measurements& measured,
                   const std::vector<int>& rows) {
  return predict_points(state, pick(measured, rows));
}

/// Out-of-fold predictions of the three models compared, for one set of held-out rows.
struct Prediction3 {
  Rows3 nominal, geometry, full;
  Eigen::VectorXd turn_errors;  // of the full one, if orientations are fitted
};

void predict_held(const Cell& cell, const Measurements& measured, const Fitted& fitted,
                  const std::vector<int>& fit, const std::vector<int>& held, Prediction3& out) {
  const ArmState nominal = place_nominal(cell, measured, fit);
  overwrite(out.nominal, held, predicted_at(nominal, measured, held));
  overwrite(out.geometry, held, predicted_at(fitted.geometry_only, measured, held));
  overwrite(out.full, held, predicted_at(fitted.calibration.state, measured, held));
  if (out.turn_errors.size() > 0)
    out.turn_errors(held) = turn_errors(fitted.calibration.state, pick(measured, held));
}

ErrorStats stats_of(const Measurements& measured, const Rows3& predicted,
                    const std::vector<int>& rows) {
  const Rows3 error = residuals(measured, predicted);
  std::vector<double> norms;
  norms.reserve(rows.size());
  for (int i : rows) norms.push_back(error.row(i).norm());
  return summarise(std::move(norms));
}

/// Held-out poses far outside the scatter of the others. They stay in the figure.
void find_held_outliers(const Measurements& measured, const std::vector<int>& held, Fit& out) {
  const Rows3 error = residuals(measured, out.predicted_M);
  const int axes =
      static_cast<int>(std::count(measured.has_axis.begin(), measured.has_axis.end(), true));
  const double sigma = std::max(out.floor.sigma_m, kSmallestScatter_m);
  Eigen::VectorXd distance(static_cast<Eigen::Index>(held.size()));
  for (std::size_t i = 0; i < held.size(); ++i) distance(i) = error.row(held[i]).norm() / sigma;
  const double scatter = usual_scatter(distance, axes);
  std::vector<int> rest;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double times = distance(i) / scatter;
    if (times > kFarTimes)
      out.held_outliers.push_back({held[i], distance(i) * sigma, times});
    else
      rest.push_back(held[i]);
  }
  out.held_without_outliers = stats_of(measured, out.predicted_M, rest);
}

std::string named(const Measurements& measured, const std::vector<Outlier>& found) {
  std::vector<std::string> names;
  for (const auto& outlier : found)
    names.push_back(
        fmt::format("{} ({:.2f} mm)", measured.pose[outlier.row], outlier.error_m * 1e3));
  if (names.size() > kListed) {
    names.resize(kListed);
    names.push_back(fmt::format("{} more", found.size() - kListed));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void remark_on_outliers(const Measurements& measured, Fit& out) {
  constexpr const char* kHelp = "measure them again, or mark them: column set = ignore";
  const auto& fitted = out.calibration.outliers;
  if (!fitted.empty())
    out.remarks.push_back({.severity = Severity::kWarning,
                           .code = "W-FIT-OUTLIERS",
                           .message = fmt::format("{} of the fit poses contradict the others and "
                                                  "were not fitted: {}",
                                                  fitted.size(), named(measured, fitted)),
                           .help = kHelp});
  // With folds a pose is both, and named already.
  if (!out.held_outliers.empty() && out.split.folds == 0)
    out.remarks.push_back({.severity = Severity::kWarning,
                           .code = "W-FIT-HELD-OUTLIERS",
                           .message = fmt::format("held-out poses that stand out, and count in the "
                                                  "figures: {}",
                                                  named(measured, out.held_outliers)),
                           .help = kHelp});
}

void remark_on_repeats_of_held(Fit& out) {
  if (out.split.repeats_of_held == 0) return;
  out.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-FIT-HELD-TWICE",
       .message = fmt::format("{} rows repeat poses that are held out and were not fitted: else "
                              "these poses would vouch for themselves",
                              out.split.repeats_of_held),
       .help = "hold out poses that are not fitted, all repeats of a pose on one side"});
}

/// Joints that stand where they are in all poses of the fit.
std::vector<std::string> still_joints(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows) {
  std::vector<std::string> out;
  const RowsN q = measured.q(rows, Eigen::all);
  for (Eigen::Index j = 0; j < q.cols(); ++j)
    if (q.col(j).maxCoeff() - q.col(j).minCoeff() < kStill)
      out.push_back(cell.nominal.joints[static_cast<std::size_t>(j)].name);
  return out;
}

void remark_on_still_joints(Fit& out) {
  if (out.still.empty()) return;
  out.remarks.push_back({.severity = Severity::kWarning,
                         .code = "W-FIT-STILL",
                         .message = fmt::format("{} never moved in the poses of the fit: whatever "
                                                "is wrong there nobody can see",
                                                fmt::join(out.still, ", ")),
                         .help = "measure poses all over the joint limits: plumb plan --n 30"});
}

/// How many times the noise an arm that is right may miss poses it has not seen, its numbers fitted
/// to so few. With d = n - p - 1 the mean square grows by 1 + p / d, of normal columns [Stein
/// 1960], and is known to sqrt(2 / d), two of which are allowed.
double unavoidable_ratio(const Measurements& measured, const Fit& fit) {
  const auto axes = std::count(measured.has_axis.begin(), measured.has_axis.end(), true);
  const double share = fit.split.folds > 0 ? 1.0 - 1.0 / static_cast<double>(fit.split.folds) : 1.0;
  const double n = share * static_cast<double>(axes * fit.fit.n);
  const auto p = static_cast<double>(fit.calibration.estimates.size());
  const double d = std::max(1.0, n - p - 1.0);
  return std::sqrt((1.0 + p / d) * (1.0 + 2.0 * std::sqrt(2.0 / d)));
}

void remark_on_orientation(const Cell& cell, const Measurements& measured, Fit& out) {
  if (!measured.has_orientation() || cell.measurement.sigma_rad) return;
  out.remarks.push_back({.severity = Severity::kNote,
                         .code = "N-FIT-ORIENTATION",
                         .message = "measured orientations are not used: their noise is not stated",
                         .help = "to fit them too: [measurement] sigma_urad = 100"});
}

Fit assemble(const Cell& cell, const Measurements& measured, Split split) {
  Fit out;
  out.split = std::move(split);
  if (measured.departure_B.rows() > 0) out.base = Base::kController;
  const std::vector<int> fit = fit_rows(out.split);
  Fitted final_model = fit_on(cell, measured, fit);
  const Rows3 final_points = predict_points(final_model.calibration.state, measured);
  Prediction3 predicted{final_points, final_points, final_points, {}};
  if (measured.has_orientation() && cell.measurement.sigma_rad)
    predicted.turn_errors = Eigen::VectorXd::Zero(measured.size());
  for (int k = 0; k < out.split.folds; ++k) {
    const auto inside = fit_rows(out.split, k);
    predict_held(cell, measured, fit_on(cell, measured, inside), inside, held_rows(out.split, k),
                 predicted);
  }
  if (out.split.folds == 0)
    predict_held(cell, measured, final_model, fit, held_rows(out.split), predicted);
  const auto held = held_rows(out.split);
  out.nominal_held = stats_of(measured, predicted.nominal, held);
  out.geometry_held = stats_of(measured, predicted.geometry, held);
  out.held = stats_of(measured, predicted.full, held);
  if (predicted.turn_errors.size() > 0) {
    const Eigen::VectorXd turns = predicted.turn_errors(held);
    out.turn_held = summarise({turns.begin(), turns.end()});
  }
  out.fit = stats_of(measured, final_points, fit);
  out.predicted_M = std::move(predicted.full);
  out.floor = noise_floor(cell, measured, final_model.calibration.state);
  out.calibration = std::move(final_model.calibration);
  find_held_outliers(measured, held, out);
  out.still = still_joints(cell, measured, fit);
  out.unavoidable_ratio = unavoidable_ratio(measured, out);
  out.remarks = out.calibration.remarks;
  remark_on_outliers(measured, out);
  remark_on_repeats_of_held(out);
  remark_on_still_joints(out);
  remark_on_orientation(cell, measured, out);
  out.tree = std::move(final_model.tree);
  return out;
}

}  // namespace

Fit fit_cell(const Cell& cell, const Measurements& measured) {
  return assemble(cell, measured,
                  split_poses(measured, cell.measurement.held_out, cell.measurement.seed));
}

Fit fit_all(const Cell& cell, const Measurements& measured) {
  Split split;
  split.fold.assign(measured.size(), -1);
  split.held.assign(measured.size(), false);
  split.used.assign(measured.size(), true);
  for (int i = 0; i < measured.size(); ++i) split.used[i] = measured.set[i] != SetMark::kIgnore;
  return assemble(cell, measured, std::move(split));
}

}  // namespace plumb::offline

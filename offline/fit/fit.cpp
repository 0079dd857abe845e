// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fit/arm_state.hpp"
#include "tree/domain.hpp"

namespace plumb::offline {
namespace {

constexpr double kFarTimes = 6.0;              // the usual scatter: an outlier
constexpr double kSmallestScatter_m = 0.1e-6;  // of noise-free data
constexpr std::size_t kListed = 5;
constexpr double kAtTheFloor = 1.3;  // times the noise floor: nothing left to explain

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
};

void predict_held(const Cell& cell, const Measurements& measured, const Fitted& fitted,
                  const std::vector<int>& fit, const std::vector<int>& held, Prediction3& out) {
  const ArmState nominal = place_nominal(cell, measured, fit);
  overwrite(out.nominal, held, predicted_at(nominal, measured, held));
  overwrite(out.geometry, held, predicted_at(fitted.geometry_only, measured, held));
  overwrite(out.full, held, predicted_at(fitted.calibration.state, measured, held));
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

void remark_on_outliers(const Measurements& measured, Fit& out) {
  const auto& found = out.calibration.outliers;
  if (found.empty()) return;
  std::vector<std::string> names;
  for (const auto& outlier : found)
    names.push_back(
        fmt::format("{} ({:.2f} mm)", measured.pose[outlier.row], outlier.error_m * 1e3));
  if (names.size() > kListed) {
    names.resize(kListed);
    names.push_back(fmt::format("{} more", found.size() - kListed));
  }
  out.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-FIT-OUTLIERS",
       .message = fmt::format("{} of the fit poses contradict the others and were not fitted: {}",
                              found.size(), fmt::join(names, ", ")),
       .help = "measure them again, or mark them: column set = ignore"});
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
  Prediction3 predicted{final_points, final_points, final_points};
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
  out.fit = stats_of(measured, final_points, fit);
  out.predicted_M = std::move(predicted.full);
  out.floor = noise_floor(cell, measured);
  out.calibration = std::move(final_model.calibration);
  find_held_outliers(measured, held, out);
  out.remarks = out.calibration.remarks;
  remark_on_outliers(measured, out);
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

std::string verdict(const Fit& fit, double tolerance_m) {
  if (fit.held.n == 0) return "No pose was held out: this fit says nothing about its accuracy.";
  const double mean = fit.held.mean * 1e3, p95 = fit.held.p95 * 1e3;
  const bool within = fit.held.p95 <= tolerance_m;
  const std::string size = fmt::format(
      "held-out error {:.3f} mm mean, {:.3f} mm at 95 % ({} poses)", mean, p95, fit.held.n);
  if (fit.floor.source == NoiseFloor::Source::kNone)
    return fmt::format("{}: {}; tolerance {:.3f} mm; noise floor unknown.",
                       within ? "Good" : "Not good enough", size, tolerance_m * 1e3);
  const double ratio = fit.floor.mean_m > 0 ? fit.held.mean / fit.floor.mean_m : 0.0;
  const std::string floor = fmt::format("noise floor {:.3f} mm", fit.floor.mean_m * 1e3);
  if (within && ratio <= kAtTheFloor)
    return fmt::format("Good: {}, at the {}; nothing more can be learnt from these poses.", size,
                       floor);
  if (within)
    return fmt::format(
        "Good: {}, within {:.3f} mm; but {:.1f} times the {}: something physical is "
        "still missing.",
        size, tolerance_m * 1e3, ratio, floor);
  if (ratio <= kAtTheFloor)
    return fmt::format("Limited by the measurement: {}, at the {}, but the tolerance is {:.3f} mm.",
                       size, floor, tolerance_m * 1e3);
  return fmt::format(
      "Not good enough: {}, {:.1f} times the {} and over the tolerance of {:.3f} mm: "
      "something physical is missing.",
      size, ratio, floor, tolerance_m * 1e3);
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "show/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/joint_shares.hpp"
#include "fit/repeatability.hpp"
#include "fit/series.hpp"
#include "fit/step_motions.hpp"
#include "fit/verdict.hpp"
#include "show/heads.hpp"
#include "show/text_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

std::vector<std::string> row(const std::string& name, const ErrorStats& s,
                             const MeanInterval& interval = {}) {
  if (s.n == 0) return {name, "0", "-", "-", "-", "-", "-"};
  return {name,     fmt::format("{}", s.n), mm(s.mean), text_of(interval), mm(s.rms), mm(s.p95),
          mm(s.max)};
}

std::string turn_table(const ErrorStats& s) {
  if (s.n == 0) return "";
  TextTable table({"orientation error [deg]", head::kReadings, head::kMean, head::kRms, head::kP95,
                   head::kMax});
  const auto deg = [](double rad) { return fmt::format("{:.4f}", to_deg(rad)); };
  table.add({"held-out, calibrated", fmt::format("{}", s.n), deg(s.mean), deg(s.rms), deg(s.p95),
             deg(s.max)});
  return "\n" + table.text();
}

constexpr double kClearShare = 0.15;  // of the squared error: scatter itself shows up to a tenth
constexpr double kMore = 1.001;       // times the noise floor of the readings alone
constexpr const char* kNoFloor = "neither repeats of a pose nor sigma_um are given";

}  // namespace

std::string text_of(const MeanInterval& interval) {
  if (!std::isfinite(interval.low)) return "";
  return mm(interval.low) + " .. " + mm(interval.high);
}

void add_interval(const MeanInterval& interval, Json& out) {
  constexpr const char* kTooFew = "fewer than three poses were held out";
  put(out, "mean_se_mm", to_mm(interval.se), kTooFew);
  put(out, "mean_low_mm", to_mm(interval.low), kTooFew);
  put(out, "mean_high_mm", to_mm(interval.high), kTooFew);
}

namespace {

/// Whether a function of one joint's angle explains a clear part of the error. Scatter hardly does.
bool depends_on_a_joint(const Measurements& measured, const Fit& fit,
                        const std::vector<int>& rows) {
  const Rows3 error_M = residuals(measured, fit.predicted_M);
  const StepMotions motions(fit.calibration.state, measured, series(measured, error_M, rows));
  const auto shares = compare::joint_shares(motions, measured.q);
  return std::any_of(shares.begin(), shares.end(),
                     [](const auto& s) { return s.matters && s.share > kClearShare; });
}

}  // namespace

bool scatter_in_floor(const Cell& cell, const Measurements& measured, const Fit& fit) {
  if (fit.floor.source == NoiseFloor::Source::kNone) return false;
  return fit.floor.sigma_m > kMore * noise_floor(cell, measured, fit.calibration.state).sigma_m;
}

std::string verdict_with_scatter(const Cell& cell, const Measurements& measured, const Fit& fit) {
  const bool in_floor = scatter_in_floor(cell, measured, fit);
  const std::string out = verdict(fit, cell.tolerance_m, in_floor);
  const auto excess = held_out_excess_of(fit);
  // A run of another cell file than the present one does not know its parameters.
  const bool known = !fit.calibration.parameters.empty();
  if (!excess || !excess->lack_of_fit() || in_floor || !known) return out;
  const auto rows = without_outliers(
      without_outliers(fit_rows(fit.split), fit.calibration.outliers), fit.held_outliers);
  const Repeatability scatter = repeatability(cell, measured, fit.calibration, rows);
  if (!scatter.supported() || depends_on_a_joint(measured, fit, rows)) return out;
  return fmt::format(
      "{} That, or the joints do not come back to the same place ({}); plumb diagnose tells which.",
      out, in_words(cell, scatter));
}

std::string folds_text(int folds, int readings) {
  if (folds == 0) return "";
  return fmt::format(
      "  held-out: {} folds, each predicted by a model fitted without it; the model itself uses "
      "all {}\n",
      folds, readings);
}

const char* fit_row_name(const Fit& fit) {
  return fit.calibration.outliers.empty() ? "fit (never accuracy)" : "fit, with its outliers";
}

std::string error_table(const Measurements& measured, const Fit& fit) {
  TextTable table({head::kPositionError, head::kReadings, head::kMean, head::kInterval, head::kRms,
                   head::kP95, head::kMax});
  table.add(
      row(fit.base == Base::kArm ? "held-out, nominal arm" : "held-out, controller's own positions",
          fit.nominal_held));
  if (fit.tree) table.add(row("held-out, without the tree", fit.geometry_held));
  table.add(row("held-out, calibrated", fit.held, held_out_interval(measured, fit)));
  if (!fit.held_outliers.empty())
    table.add(row("  without its outliers", fit.held_without_outliers));
  table.add(row(fit_row_name(fit), fit.fit));
  if (fit.floor.source == NoiseFloor::Source::kNone)
    table.add({"noise floor: unknown"});
  else
    table.add({"noise floor", "", mm(fit.floor.mean_m), "", mm(fit.floor.rms_m)});
  return table.text() + folds_text(fit.split.folds, fit.fit.n) + turn_table(fit.turn_held);
}

void add_turns(const ErrorStats& turn_held, Json& out) {
  const ErrorStats& s = turn_held;
  if (s.n == 0) return put_null(out, "held_out_orientation", "orientations are not fitted");
  Json turns{{"n", s.n}};
  put(turns, "mean_deg", to_deg(s.mean));
  put(turns, "rms_deg", to_deg(s.rms));
  put(turns, "p95_deg", to_deg(s.p95));
  put(turns, "max_deg", to_deg(s.max));
  out["held_out_orientation"] = turns;
}

void add_floor(const NoiseFloor& floor, Json& out) {
  if (floor.source == NoiseFloor::Source::kNone) {
    put_null(out, "noise_floor_mm", kNoFloor);
    put_null(out, "noise_floor_rms_mm", kNoFloor);
    return;
  }
  put(out, "noise_floor_mm", to_mm(floor.mean_m));
  put(out, "noise_floor_rms_mm", to_mm(floor.rms_m));
  out["noise_floor_source"] = floor.source == NoiseFloor::Source::kRepeats ? "repeats" : "sigma";
}

}  // namespace plumb::offline::show

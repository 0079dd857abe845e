// SPDX-License-Identifier: Apache-2.0
#include "show/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/orientation_words.hpp"
#include "show/heads.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

std::vector<std::string> row(const std::string& name, const ErrorStats& s,
                             const MeanInterval& interval = {}) {
  if (s.n == 0) return {name, "0", "-", "-", "-", "-", "-"};
  return {name,     fmt::format("{}", s.n), mm(s.mean), text_of(interval), mm(s.rms), mm(s.p95),
          mm(s.max)};
}

const char* floor_label(NoiseFloor::Source source) {
  return source == NoiseFloor::Source::kSigma ? "noise floor, sigma as stated" : "noise floor";
}

Table turn_table(const ErrorStats& s, const OrientationFloor& floor) {
  Table table{.name = "orientations",
              .caption = "Orientation errors, measured - predicted [deg]",
              .head = {"orientation error [deg]", head::kReadings, head::kMean, head::kRms,
                       head::kP95, head::kMax}};
  if (s.n == 0) return table;
  table.add({"held-out, calibrated", fmt::format("{}", s.n), deg(s.mean), deg(s.rms), deg(s.p95),
             deg(s.max)});
  if (floor.known()) table.add({floor_label(floor.source), "", deg(floor.mean_rad)});
  return table;
}

/// The row of the fitted readings says so if it counts outliers.
const char* fit_row_name(const Fit& fit) {
  return fit.calibration.outliers.empty() ? "fit (never accuracy)" : "fit, with its outliers";
}

/// The noise floor with its source, and what is only inferred.
std::vector<std::vector<std::string>> floor_rows(const NoiseFloor& floor) {
  if (floor.source == NoiseFloor::Source::kNone) return {{"noise floor: unknown"}};
  std::vector<std::vector<std::string>> out{
      {floor_label(floor.source), "", mm(floor.mean_m), "", mm(floor.rms_m)}};
  if (floor.inferred_m > 0.0)
    out.push_back({"  inferred, if the joints scatter", "", mm(floor.inferred_m)});
  return out;
}

Table error_table(const Measurements& measured, const Fit& fit) {
  Table table{.name = "errors",
              .caption = "Position errors, measured - predicted [mm]",
              .head = {head::kPositionError, head::kReadings, head::kMean, head::kInterval,
                       head::kRms, head::kP95, head::kMax}};
  table.add(
      row(fit.base == Base::kArm ? "held-out, nominal arm" : "held-out, controller's own positions",
          fit.nominal_held));
  if (fit.tree) table.add(row("held-out, without the tree", fit.geometry_held));
  table.add(row("held-out, calibrated", fit.held, held_out_interval(measured, fit)));
  if (!fit.held_outliers.empty())
    table.add(row("  without its outliers", fit.held_without_outliers));
  table.add(row(fit_row_name(fit), fit.fit));
  for (auto& one : floor_rows(fit.floor)) table.add(std::move(one));
  return table;
}

constexpr const char* kNoFloor = "neither repeats of a pose nor sigma_um are given";

const char* source_name(NoiseFloor::Source source) {
  switch (source) {
    case NoiseFloor::Source::kRepeats:
      return "repeats";
    case NoiseFloor::Source::kSigma:
      return "sigma";
    default:
      return "none";
  }
}

/// What was measured or stated of the noise, apart from what is only inferred.
Json floor_json(const NoiseFloor& floor) {
  const bool known = floor.source != NoiseFloor::Source::kNone;
  Json out{{"source", source_name(floor.source)}};
  put(out, "measured_mm", known ? to_mm(floor.mean_m) : NAN, kNoFloor);
  put(out, "inferred_mm", floor.inferred_m > 0.0 ? to_mm(floor.inferred_m) : NAN,
      "no diagnosis takes what the model leaves for scatter of the joints");
  return out;
}

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

Blocks folds_note(int folds, int readings) {
  if (folds == 0) return {};
  return {
      under(fmt::format("held-out: {} folds, each predicted by a model fitted without it; the "
                        "model itself uses all {}",
                        folds, readings))};
}

Blocks error_blocks(const Measurements& measured, const Fit& fit) {
  Blocks out{error_table(measured, fit)};
  append(out, folds_note(fit.split.folds, fit.fit.n));
  out.emplace_back(turn_table(fit.turn_held, fit.turn_floor));
  return out;
}

void add_turns(const Fit& fit, Json& out) {
  const ErrorStats& s = fit.turn_held;
  if (s.n == 0) return put_null(out, "held_out_orientation", "orientations are not fitted");
  Json turns{{"n", s.n}};
  put(turns, "mean_deg", to_deg(s.mean));
  put(turns, "rms_deg", to_deg(s.rms));
  put(turns, "p95_deg", to_deg(s.p95));
  put(turns, "max_deg", to_deg(s.max));
  if (fit.turn_floor.known())
    put(turns, "noise_floor_deg", to_deg(fit.turn_floor.mean_rad));
  else
    put_null(turns, "noise_floor_deg", "an earlier version kept none");
  out["held_out_orientation"] = turns;
}

void add_orientation(const MeasuredOrientations& judged, const std::vector<std::string>& meant,
                     Json& out) {
  if (judged.kind == MeasuredOrientations::Kind::kNone) return;
  Json& one = out["orientation"];
  one = {{"kind", name_of(judged.kind)},
         {"used", judged.stated && judged.fit_to_use()},
         {"meant", meant},
         {"text", in_words(judged, meant)}};
  put(one, "as_labelled_urad", judged.labelled_rad * 1e6);
  put(one, "scatter_urad", judged.left_rad * 1e6);
}

void add_floor(const NoiseFloor& floor, Json& out) {
  out["noise_floor"] = floor_json(floor);
  if (floor.source == NoiseFloor::Source::kNone) {
    put_null(out, "noise_floor_mm", kNoFloor);
    put_null(out, "noise_floor_rms_mm", kNoFloor);
    return;
  }
  put(out, "noise_floor_mm", to_mm(floor.mean_m));
  put(out, "noise_floor_rms_mm", to_mm(floor.rms_m));
  out["noise_floor_source"] = source_name(floor.source);
  if (floor.inferred_m > 0.0) out["inferred_floor_mm"] = to_mm(floor.inferred_m);
}

}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#include "runs/run_json.hpp"

#include <fmt/format.h>

#include <array>

#include "cell/packed_matrix.hpp"
#include "cell/reading_digest.hpp"
#include "cell/table_blocks.hpp"
#include "fit/orientation_words.hpp"
#include "program/problem.hpp"
#include "runs/kept_fields.hpp"
#include "runs/model_json.hpp"

namespace plumb::offline {
template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Estimate>& estimate) {
  fields("name", estimate.name);
  fields("length", estimate.is_length);
  fields("robot", estimate.of_robot);
  fields("value", estimate.value);
  fields("nominal", estimate.nominal);
  fields("std", estimate.std);
  fields.later("unit", estimate.unit);
}

/// Frame and target of the second set-up and those after it.
template <class Fields>
void describe(Fields& fields, typename Fields::template Of<ArmState::Placing>& place) {
  fields("frame_of", place.frame_of);
  fields("target_of", place.target_of);
  fields("frame", place.X_MB);
  fields("target", place.X_TG);
  fields.later("length_m", place.length_m);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Likeness>& likeness) {
  fields("run", likeness.run);
  fields("kind", likeness.kind);
  fields("numbers", likeness.numbers);
  fields("same_chance", likeness.same_chance);
  fields("share", likeness.share);
  fields("spread_m", likeness.spread_m);
  fields("spread_rad", likeness.spread_rad);
  fields("changed", likeness.changed);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Calibration>& calibration) {
  auto& arm = calibration.state.arm;
  fields("chain", arm.calibrated);
  fields("domain", arm.domain);
  fields.later("effects", arm.effects);
  fields.later("mechanics", arm.mechanics);
  fields.later("gravity", arm.gravity);
  fields("frame", calibration.state.X_MB);
  fields("target", calibration.state.X_TG);
  fields.later("length_m", calibration.state.length_m);
  fields.later("more_setups", calibration.state.more);
  fields("estimates", calibration.estimates);
  fields("held", calibration.held);
  fields.symmetric("covariance", calibration.covariance, calibration.estimates.size());
  fields("rank", calibration.rank);
  fields("calibrability", calibration.calibrability);
  fields("sigma0", calibration.sigma0);
  fields("iterations", calibration.iterations);
  fields.if_any("likeness", calibration.likeness);
  fields.where(calibration.likeness.has_value(), "decided", calibration.decided);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Outlier>& outlier) {
  fields("row", outlier.row);
  fields("error_m", outlier.error_m);
  fields("times", outlier.times);
  fields.later("pose", outlier.pose);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<TreeChoice>& tree) {
  fields("trees", tree.trees);
  fields("domain", tree.domain);
  fields("leaves", tree.leaves);
  fields("cv_before_m", tree.cv_before_m);
  fields("cv_after_m", tree.cv_after_m);
  fields("gain_se_m", tree.gain_se_m);
  fields("reason", tree.reason);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<RecheckOf>& recheck) {
  fields("parent", recheck.parent);
  fields("verdict", recheck.verdict);
  fields("words", recheck.words);
  fields("before", recheck.before);
  fields("expected_m", recheck.expected_m);
  fields("limit_m", recheck.limit_m);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<TakenOver>& from) {
  fields("check_sum", from.check_sum);
  fields("inputs", from.inputs);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<MeasuredOrientations>& judged) {
  fields.named("kind", judged.kind, MeasuredOrientations::Kind::kUnexplained);
  fields("labelled_rad", judged.labelled_rad);
  fields("left_rad", judged.left_rad);
  fields("stated", judged.stated);
  fields.if_any("times", judged.times);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Run>& run) {
  auto& fit = run.fit;
  fields("number", run.number);
  fields("created", run.created);
  fields("cell_sha256", run.cell_sha256);
  fields.later("fit_sha256", run.fit_sha256);
  fields("inputs", run.inputs);
  fields("effects", run.effects);
  fields.named("base", fit.base, Base::kController);
  fields("calibration", fit.calibration);
  fields("tree", fit.tree);
  fields("folds", fit.split.folds);
  fields("held_out", fit.held);
  fields("held_out_nominal", fit.nominal_held);
  fields("held_out_geometry", fit.geometry_held);
  fields.later("held_out_turn", fit.turn_held);
  fields("fit", fit.fit);
  fields.later("outliers", fit.calibration.outliers);
  fields.later("held_out_outliers", fit.held_outliers);
  fields.later("held_out_without_outliers", fit.held_without_outliers);
  fields("noise_floor", fit.floor);
  fields.where(fit.turn_floor.known(), "orientation_floor", fit.turn_floor);
  fields.later("unavoidable_ratio", fit.unavoidable_ratio);
  fields.later("still_joints", fit.still);
  fields.later("size_unknown", fit.size_unknown);
  fields.where(fit.orientations.kind != MeasuredOrientations::Kind::kNone, "orientations",
               fit.orientations);
  fields.if_any("from", run.from);
  fields.if_any("recheck", run.recheck);
}

namespace {

constexpr const char* kSchema = "run/1";
constexpr const char* kFloorSchema = "run.noise_floor/1";

/// What the description of its fields does not say.
void check_placings(const std::vector<ArmState::Placing>& more) {
  int self = 0;
  for (const auto& place : more) {
    ++self;
    if (place.frame_of < 0 || place.frame_of > self || place.target_of < 0 ||
        place.target_of > self)
      throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                                   .message = "run.json holds set-ups that refer to none",
                                   .help = "delete this run and fit again: plumb fit"});
  }
}

const Column& column(const Table& table, const char* name) {
  if (const Column* found = table.find(name)) return *found;
  throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                               .message = fmt::format("{} lacks column '{}'", table.file, name),
                               .help = "delete this run and fit again: plumb fit"});
}

}  // namespace

Json run_to_json(const Run& run) {
  Json out{{"schema", kSchema}};
  FieldWriter fields(out);
  describe(fields, run);
  return out;
}

Run run_from_json(const Json& j) {
  if (j.at("schema") != kSchema)
    throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                                 .message = "run.json is of another schema",
                                 .help = "fit again: plumb fit"});
  Run run = from_kept<Run>(j);
  Fit& fit = run.fit;
  Calibration& calibration = fit.calibration;
  check_placings(calibration.state.more);
  // Earlier files lack these.
  if (!j.contains("fit_sha256")) run.fit_sha256 = run.cell_sha256;
  if (!j.contains("held_out_without_outliers")) fit.held_without_outliers = fit.held;
  if (!j.at("calibration").contains("decided"))
    calibration.decided = static_cast<double>(calibration.estimates.size());
  if (fit.tree) {
    calibration.state.arm.trees = fit.tree->trees;
    calibration.state.arm.domain = fit.tree->domain;
  }
  return run;
}

Json floor_to_json(const NoiseFloor& floor) {
  return {{"schema", kFloorSchema}, {"noise_floor", kept_json(floor)}};
}

NoiseFloor floor_from_json(const Json& j) {
  if (j.at("schema") != kFloorSchema)
    throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                                 .message = "noise_floor.json is of another schema",
                                 .help = "diagnose again: plumb diagnose"});
  return from_kept<NoiseFloor>(j.at("noise_floor"));
}

std::string predictions_to_csv(const Measurements& measured, const Fit& fit) {
  const bool turns = fit.turned_G.size() > 0;
  std::string out = fmt::format("pose,set,fold,px_m,py_m,pz_m,{}note\n",
                                turns ? "turn_x_rad,turn_y_rad,turn_z_rad," : "");
  for (int i = 0; i < measured.size(); ++i) {
    const auto p = fit.predicted_M.row(i);
    const char* set = !fit.split.used[i]                            ? "ignore"
                      : fit.split.held[i] || fit.split.fold[i] >= 0 ? "held"
                                                                    : "fit";
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},", i + 1, set, fit.split.fold[i],
                   p(0), p(1), p(2));
    if (turns)
      for (const double turn : fit.turned_G.row(i))
        fmt::format_to(std::back_inserter(out), "{},", turn);
    fmt::format_to(std::back_inserter(out), "{}\n", reading_digest(measured, i));
  }
  return out;
}

std::string predictions_from_csv(const std::filesystem::path& file, Fit& fit) {
  Split& split = fit.split;
  std::vector<double> predicted, turns;
  const auto take = [&](const Table& table) {
    const Column& set = column(table, "set");
    const Column& fold = column(table, "fold");
    const std::array axes{&column(table, "px"), &column(table, "py"), &column(table, "pz")};
    std::vector<const Column*> about;
    for (const char* name : {"turn_x", "turn_y", "turn_z"})
      if (const Column* turn = table.find(name)) about.push_back(turn);
    for (std::size_t i = 0; i < set.text.size(); ++i) {
      split.fold.push_back(static_cast<int>(fold.values[i]));
      split.used.push_back(set.text[i] != "ignore");
      split.held.push_back(set.text[i] == "held" && split.fold.back() < 0);
      for (const Column* axis : axes) predicted.push_back(axis->values[i]);
      for (const Column* axis : about) turns.push_back(axis->values[i]);
    }
  };
  split.fold.clear(), split.used.clear(), split.held.clear();
  std::string sum = read_blocks(file, take);
  fit.predicted_M =
      Eigen::Map<const Rows3>(predicted.data(), static_cast<Eigen::Index>(split.fold.size()), 3);
  fit.turned_G =
      Eigen::Map<const Rows3>(turns.data(), static_cast<Eigen::Index>(turns.size()) / 3, 3);
  return sum;
}

}  // namespace plumb::offline

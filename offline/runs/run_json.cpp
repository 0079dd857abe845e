// SPDX-License-Identifier: Apache-2.0
#include "runs/run_json.hpp"

#include <fmt/format.h>

#include <array>

#include "cell/packed_matrix.hpp"
#include "cell/reading_digest.hpp"
#include "cell/table_blocks.hpp"
#include "fit/orientation_words.hpp"
#include "program/problem.hpp"
#include "runs/json_parts.hpp"
#include "runs/model_json.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kSchema = "run/1";
constexpr const char* kFloorSchema = "run.noise_floor/1";

using OrientationKind = MeasuredOrientations::Kind;

Json to_json(const MeasuredOrientations& o) {
  Json out{{"kind", name_of(o.kind)},
           {"labelled_rad", o.labelled_rad},
           {"left_rad", o.left_rad},
           {"stated", o.stated}};
  if (o.times) out["times"] = *o.times;
  return out;
}

OrientationKind orientation_kind(const std::string& name) {
  for (int kind = 0; kind <= static_cast<int>(OrientationKind::kUnexplained); ++kind)
    if (name == name_of(static_cast<OrientationKind>(kind)))
      return static_cast<OrientationKind>(kind);
  throw Failure(Exit::kInput,
                {.code = "E-RUN-DAMAGED",
                 .message = fmt::format("run.json says orientations are '{}', which is no kind of "
                                        "them",
                                        name),
                 .help = "delete this run and fit again: plumb fit"});
}

MeasuredOrientations orientations_from(const Json& j) {
  MeasuredOrientations out{.kind = orientation_kind(j.at("kind")),
                           .readings = {},
                           .labelled_rad = j.at("labelled_rad"),
                           .left_rad = j.at("left_rad"),
                           .stated = j.at("stated"),
                           .times = {}};
  if (out.kind == OrientationKind::kScattered || out.kind == OrientationKind::kMissed)
    out.times = j.at("times").get<double>();
  return out;
}

Json to_json(const NoiseFloor& f) {
  return {{"sigma_m", f.sigma_m},
          {"mean_m", f.mean_m},
          {"rms_m", f.rms_m},
          {"dof", f.dof},
          {"source", static_cast<int>(f.source)},
          {"inferred_m", f.inferred_m}};
}
NoiseFloor floor_from(const Json& j) {
  return {.sigma_m = j.at("sigma_m"),
          .mean_m = j.at("mean_m"),
          .rms_m = j.at("rms_m"),
          .dof = j.value("dof", 0),
          .source = static_cast<NoiseFloor::Source>(j.at("source").get<int>()),
          .inferred_m = j.value("inferred_m", 0.0)};
}

Json to_json(const Estimate& e) {
  return {{"name", e.name},   {"length", e.is_length}, {"robot", e.of_robot},
          {"value", e.value}, {"nominal", e.nominal},  {"std", e.std},
          {"unit", e.unit}};
}
Estimate estimate_from(const Json& j) {
  return {.name = j.at("name"),
          .is_length = j.at("length"),
          .of_robot = j.at("robot"),
          .unit = j.value("unit", std::string()),
          .value = j.at("value"),
          .nominal = j.at("nominal"),
          .std = j.at("std")};
}

/// Frames and targets of all set-ups after the first.
Json to_json(const std::vector<ArmState::Placing>& more) {
  Json out = Json::array();
  for (const auto& p : more)
    out.push_back({{"frame_of", p.frame_of},
                   {"target_of", p.target_of},
                   {"frame", p.X_MB},
                   {"target", p.X_TG}});
  return out;
}
std::vector<ArmState::Placing> placings_from(const Json& j) {
  std::vector<ArmState::Placing> out;
  for (const auto& p : j) {
    auto& one = out.emplace_back();
    one.frame_of = p.at("frame_of");
    one.target_of = p.at("target_of");
    const int self = static_cast<int>(out.size());
    if (one.frame_of < 0 || one.frame_of > self || one.target_of < 0 || one.target_of > self)
      throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                                   .message = "run.json holds set-ups that refer to none",
                                   .help = "delete this run and fit again: plumb fit"});
    p.at("frame").get_to(one.X_MB);
    p.at("target").get_to(one.X_TG);
  }
  return out;
}

Json to_json(const Likeness& l) {
  return {{"run", l.run},
          {"kind", static_cast<int>(l.kind)},
          {"numbers", l.numbers},
          {"same_chance", l.same_chance},
          {"share", l.share},
          {"spread_m", l.spread_m},
          {"spread_rad", l.spread_rad},
          {"changed", l.changed}};
}
Likeness likeness_from(const Json& j) {
  return {.kind = static_cast<Likeness::Kind>(j.at("kind").get<int>()),
          .run = j.at("run"),
          .numbers = j.at("numbers"),
          .same_chance = j.at("same_chance"),
          .share = j.at("share"),
          .spread_m = j.at("spread_m"),
          .spread_rad = j.at("spread_rad"),
          .changed = j.at("changed")};
}

Json to_json(const Calibration& c) {
  Json estimates = Json::array();
  for (const auto& e : c.estimates) estimates.push_back(to_json(e));
  Json out = {{"chain", c.state.arm.calibrated},
              {"domain", c.state.arm.domain},
              {"effects", c.state.arm.effects},
              {"mechanics", c.state.arm.mechanics},
              {"gravity", c.state.arm.gravity},
              {"frame", c.state.X_MB},
              {"target", c.state.X_TG},
              {"more_setups", to_json(c.state.more)},
              {"estimates", estimates},
              {"held", c.held},
              {"covariance", packed(c.covariance)},
              {"rank", c.rank},
              {"calibrability", c.calibrability},
              {"sigma0", c.sigma0},
              {"iterations", c.iterations}};
  if (c.likeness) out["likeness"] = to_json(*c.likeness);
  if (c.likeness) out["decided"] = c.decided;
  return out;
}
Calibration calibration_from(const Json& j) {
  Calibration c;
  j.at("chain").get_to(c.state.arm.calibrated);
  j.at("domain").get_to(c.state.arm.domain);
  if (j.contains("effects")) {
    j.at("effects").get_to(c.state.arm.effects);
    j.at("mechanics").get_to(c.state.arm.mechanics);
    j.at("gravity").get_to(c.state.arm.gravity);
  }
  j.at("frame").get_to(c.state.X_MB);
  j.at("target").get_to(c.state.X_TG);
  c.state.more = placings_from(j.value("more_setups", Json::array()));
  for (const auto& e : j.at("estimates")) c.estimates.push_back(estimate_from(e));
  j.at("held").get_to(c.held);
  c.covariance = unpacked(j.at("covariance"), static_cast<Eigen::Index>(c.estimates.size()));
  j.at("rank").get_to(c.rank);
  j.at("calibrability").get_to(c.calibrability);
  j.at("sigma0").get_to(c.sigma0);
  j.at("iterations").get_to(c.iterations);
  c.decided = j.value("decided", static_cast<double>(c.estimates.size()));
  if (j.contains("likeness")) c.likeness = likeness_from(j.at("likeness"));
  return c;
}

Json to_json(const std::vector<Outlier>& outliers) {
  Json out = Json::array();
  for (const auto& o : outliers)
    out.push_back({{"row", o.row}, {"error_m", o.error_m}, {"times", o.times}, {"pose", o.pose}});
  return out;
}
std::vector<Outlier> outliers_from(const Json& run, const char* key) {
  std::vector<Outlier> out;
  for (const auto& o : run.value(key, Json::array()))
    out.push_back({.row = o.at("row"),
                   .error_m = o.at("error_m"),
                   .times = o.at("times"),
                   .pose = o.value("pose", "")});
  return out;
}

Json to_json(const TreeChoice& t) {
  return {{"trees", t.trees},           {"domain", t.domain},
          {"leaves", t.leaves},         {"cv_before_m", t.cv_before_m},
          {"cv_after_m", t.cv_after_m}, {"gain_se_m", t.gain_se_m},
          {"reason", t.reason}};
}
TreeChoice tree_from(const Json& j) {
  TreeChoice t;
  j.at("trees").get_to(t.trees);
  j.at("domain").get_to(t.domain);
  j.at("leaves").get_to(t.leaves);
  j.at("cv_before_m").get_to(t.cv_before_m);
  j.at("cv_after_m").get_to(t.cv_after_m);
  j.at("gain_se_m").get_to(t.gain_se_m);
  j.at("reason").get_to(t.reason);
  return t;
}

Json to_json(const RecheckOf& r) {
  return {{"parent", r.parent},          {"verdict", r.verdict},       {"words", r.words},
          {"before", to_json(r.before)}, {"expected_m", r.expected_m}, {"limit_m", r.limit_m}};
}
RecheckOf recheck_from(const Json& j) {
  return {.parent = j.at("parent"),
          .verdict = j.at("verdict"),
          .words = j.at("words"),
          .before = stats_from(j.at("before")),
          .expected_m = j.at("expected_m"),
          .limit_m = j.at("limit_m")};
}

Json to_json(const TakenOver& t) { return {{"check_sum", t.check_sum}, {"inputs", t.inputs}}; }
TakenOver taken_over_from(const Json& j) {
  return {.check_sum = j.at("check_sum"), .inputs = j.at("inputs")};
}

const Column& column(const Table& table, const char* name) {
  if (const Column* found = table.find(name)) return *found;
  throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                               .message = fmt::format("{} lacks column '{}'", table.file, name),
                               .help = "delete this run and fit again: plumb fit"});
}

}  // namespace

Json run_to_json(const Run& run) {
  const Fit& fit = run.fit;
  Json out = {{"schema", kSchema},
              {"number", run.number},
              {"created", run.created},
              {"cell_sha256", run.cell_sha256},
              {"fit_sha256", run.fit_sha256},
              {"inputs", run.inputs},
              {"effects", run.effects},
              {"base", name_of(fit.base)},
              {"calibration", to_json(fit.calibration)},
              {"tree", nullptr},
              {"folds", fit.split.folds},
              {"held_out", to_json(fit.held)},
              {"held_out_nominal", to_json(fit.nominal_held)},
              {"held_out_geometry", to_json(fit.geometry_held)},
              {"held_out_turn", to_json(fit.turn_held)},
              {"fit", to_json(fit.fit)},
              {"outliers", to_json(fit.calibration.outliers)},
              {"held_out_outliers", to_json(fit.held_outliers)},
              {"held_out_without_outliers", to_json(fit.held_without_outliers)},
              {"noise_floor", to_json(fit.floor)}};
  out["unavoidable_ratio"] = fit.unavoidable_ratio;
  out["still_joints"] = fit.still;
  if (fit.orientations.kind != OrientationKind::kNone)
    out["orientations"] = to_json(fit.orientations);
  if (fit.tree) out["tree"] = to_json(*fit.tree);
  if (run.from) out["from"] = to_json(*run.from);
  if (run.recheck) out["recheck"] = to_json(*run.recheck);
  return out;
}

Run run_from_json(const Json& j) {
  if (j.at("schema") != kSchema)
    throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                                 .message = "run.json is of another schema",
                                 .help = "fit again: plumb fit"});
  Run run;
  j.at("number").get_to(run.number);
  j.at("created").get_to(run.created);
  j.at("cell_sha256").get_to(run.cell_sha256);
  run.fit_sha256 = j.value("fit_sha256", run.cell_sha256);
  j.at("inputs").get_to(run.inputs);
  j.at("effects").get_to(run.effects);
  Fit& fit = run.fit;
  fit.base = j.value("base", "arm") == name_of(Base::kController) ? Base::kController : Base::kArm;
  fit.calibration = calibration_from(j.at("calibration"));
  if (!j.at("tree").is_null()) {
    fit.tree = tree_from(j.at("tree"));
    fit.calibration.state.arm.trees = fit.tree->trees;
    fit.calibration.state.arm.domain = fit.tree->domain;
  }
  j.at("folds").get_to(fit.split.folds);
  fit.held = stats_from(j.at("held_out"));
  fit.nominal_held = stats_from(j.at("held_out_nominal"));
  fit.geometry_held = stats_from(j.at("held_out_geometry"));
  if (j.contains("held_out_turn")) fit.turn_held = stats_from(j.at("held_out_turn"));
  fit.fit = stats_from(j.at("fit"));
  fit.calibration.outliers = outliers_from(j, "outliers");
  fit.held_outliers = outliers_from(j, "held_out_outliers");
  fit.held_without_outliers = j.contains("held_out_without_outliers")
                                  ? stats_from(j.at("held_out_without_outliers"))
                                  : fit.held;
  fit.unavoidable_ratio = j.value("unavoidable_ratio", 1.0);
  fit.still = j.value("still_joints", std::vector<std::string>());
  if (j.contains("orientations")) fit.orientations = orientations_from(j.at("orientations"));
  fit.floor = floor_from(j.at("noise_floor"));
  if (j.contains("from")) run.from = taken_over_from(j.at("from"));
  if (j.contains("recheck")) run.recheck = recheck_from(j.at("recheck"));
  return run;
}

Json floor_to_json(const NoiseFloor& floor) {
  return {{"schema", kFloorSchema}, {"noise_floor", to_json(floor)}};
}

NoiseFloor floor_from_json(const Json& j) {
  if (j.at("schema") != kFloorSchema)
    throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                                 .message = "noise_floor.json is of another schema",
                                 .help = "diagnose again: plumb diagnose"});
  return floor_from(j.at("noise_floor"));
}

std::string predictions_to_csv(const Measurements& measured, const Fit& fit) {
  std::string out = "pose,set,fold,px_m,py_m,pz_m,note\n";
  for (int i = 0; i < measured.size(); ++i) {
    const auto p = fit.predicted_M.row(i);
    const char* set = !fit.split.used[i]                            ? "ignore"
                      : fit.split.held[i] || fit.split.fold[i] >= 0 ? "held"
                                                                    : "fit";
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{}\n", i + 1, set, fit.split.fold[i],
                   p(0), p(1), p(2), reading_digest(measured, i));
  }
  return out;
}

std::string predictions_from_csv(const std::filesystem::path& file, Fit& fit) {
  Split& split = fit.split;
  std::vector<double> predicted;
  const auto take = [&](const Table& table) {
    const Column& set = column(table, "set");
    const Column& fold = column(table, "fold");
    const std::array axes{&column(table, "px"), &column(table, "py"), &column(table, "pz")};
    for (std::size_t i = 0; i < set.text.size(); ++i) {
      split.fold.push_back(static_cast<int>(fold.values[i]));
      split.used.push_back(set.text[i] != "ignore");
      split.held.push_back(set.text[i] == "held" && split.fold.back() < 0);
      for (const Column* axis : axes) predicted.push_back(axis->values[i]);
    }
  };
  split.fold.clear(), split.used.clear(), split.held.clear();
  std::string sum = read_blocks(file, take);
  fit.predicted_M =
      Eigen::Map<const Rows3>(predicted.data(), static_cast<Eigen::Index>(split.fold.size()), 3);
  return sum;
}

}  // namespace plumb::offline

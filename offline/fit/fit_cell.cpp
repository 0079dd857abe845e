// SPDX-License-Identifier: Apache-2.0
#include "fit/fit_cell.hpp"
#include "fit/common_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arm/arm_state.hpp"
#include "arm/context_needs.hpp"
#include "arm/predicted_points.hpp"
#include "cell/artefacts.hpp"
#include "cell/replicates.hpp"
#include "cell/setups.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/constants.hpp"
#include "fit/few_poses.hpp"
#include "fit/orientation_words.hpp"
#include "fit/point_sense.hpp"
#include "fit/pose_sense.hpp"
#include "fit/unseen_points.hpp"
#include "noise/usual_errors.hpp"
#include "program/counted_words.hpp"
#include "solve/imagined_poses.hpp"
#include "tree/domain.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kListed = 5;

const EffectEntry* find_local_tree(const Cell& cell) {
  const auto it = std::find_if(cell.effects.begin(), cell.effects.end(),
                               [](const EffectEntry& e) { return is_local_tree(e.name); });
  return it == cell.effects.end() ? nullptr : &*it;
}

TreeSettings tree_settings(const Cell& cell, const EffectEntry& entry) {
  TreeSettings out;
  out.seed = cell.measurement.seed;
  // The reader of the cell has already turned a share like "2%" into a number.
  out.min_gain = number_option(entry, OptionKey::kMinGain, out.min_gain);
  const std::string form = text_option(entry, OptionKey::kForm, "");
  if (form == "crisp") out.form = TreeForm::kCrisp;
  if (form == "blended") out.form = TreeForm::kBlended;
  if (text_option(entry, OptionKey::kSplits, "") == "own") out.sharing = Sharing::kOwn;
  out.max_degree = static_cast<int>(number_option(entry, OptionKey::kTreeDegree, out.max_degree));
  return out;
}

/// Throws E-SPLIT if the frame or target of a held-out pose is to be fitted but no fitted pose has
/// it.
void check_placed(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                  const std::vector<int>& held) {
  const MeasurementSettings& m = cell.measurement;
  std::set<int> frames, targets;
  for (const int row : fit) {
    frames.insert(frame_root(m, setup_of(measured, row)));
    targets.insert(target_root(m, setup_of(measured, row)));
  }
  for (const int row : held) {
    const int k = setup_of(measured, row);
    const Setup rule = setup_rule(m, k);
    // Where a point is that no fitted row touches, its own rows tell: unseen_points.hpp.
    const bool frame = rule.is_artefact() || !rule.fit_frame || frames.contains(frame_root(m, k));
    if (frame && (!rule.fit_target || targets.contains(target_root(m, k)))) continue;
    throw Failure(
        Exit::kInput,
        {.code = "E-SPLIT",
         .message = fmt::format("every pose of set-up '{}' is held out: nothing tells its {}",
                                setup_name(m, k), frame ? "target" : "frame"),
         .help = "let plumb choose the held-out poses: held_out = \"auto\"; or say what is known: "
                 "frame = { same_as = \"another set-up\" }"});
  }
}

struct FittedModel {
  Calibration calibration;
  std::optional<TreeChoice> tree;
  ArmState geometry_only;
};

/// start: of the fit of a fold, which knows from the fit of all poses where tracker and reflector
/// stand.
FittedModel fit_on(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                   const ArmState* start = nullptr) {
  FittedModel out;
  out.calibration = start == nullptr ? calibrate(cell, measured, rows)
                                     : calibrate_from(cell, measured, rows, *start);
  const Measurements some = pick(measured, without_outliers(rows, out.calibration.outliers));
  out.calibration.state.arm.domain = trained_box(some.q);
  out.calibration.state.arm.domain.context =
      trained_context(out.calibration.state.arm, some.context);
  place_unseen_points(cell.measurement, measured, rows, out.calibration.state);
  out.geometry_only = out.calibration.state;
  const EffectEntry* entry = find_local_tree(cell);
  if (entry == nullptr) return out;
  const ArmState& state = out.geometry_only;
  const Rows3 error_B = to_base(state, some, residuals(some, predict_points(state, some)));
  out.tree =
      choose_trees(some.q, error_B, some.has_axis, pose_groups(some), tree_settings(cell, *entry));
  out.calibration.state.arm.trees = out.tree->trees;
  out.tree->domain.context = out.calibration.state.arm.domain.context;
  out.calibration.state.arm.domain = out.tree->domain;
  return out;
}

void overwrite(Rows3& all, const std::vector<int>& rows, const Rows3& with) {
  for (std::size_t i = 0; i < rows.size(); ++i) all.row(rows[i]) = with.row(i);
}

/// Predictions of the three models that are compared, out of fold where a pose is held out.
struct HeldPredictions {
  Rows3 nominal, geometry, full;
  Rows3 turned_G;  // of the full model, if orientations are fitted
};

void predict_held(const Cell& cell, const Measurements& measured, const FittedModel& fitted,
                  const std::vector<int>& fit, const std::vector<int>& held, HeldPredictions& out) {
  const auto predict = [&](const ArmState& state, Rows3& all) {
    overwrite(all, held, predict_held_out(cell.measurement, measured, fit, held, state));
  };
  predict(place_nominal(cell, measured, fit), out.nominal);
  predict(fitted.geometry_only, out.geometry);
  predict(fitted.calibration.state, out.full);
  if (out.turned_G.size() > 0)
    overwrite(out.turned_G, held, turns_of_target(fitted.calibration.state, pick(measured, held)));
}

ErrorStats stats_of(const Measurements& measured, const Rows3& predicted,
                    const std::vector<int>& rows) {
  const Rows3 error = residuals(measured, predicted);
  std::vector<double> norms;
  norms.reserve(rows.size());
  for (int i : rows) norms.push_back(error.row(i).norm());
  return summarise(std::move(norms));
}

/// Mean variance [m^2] of a predicted coordinate at poses all over the joint limits, due to the
/// uncertainty of the geometry that the readings and an earlier run leave; 0 without an earlier
/// run.
double left_open(const Cell& cell, const Measurements& measured, const Calibration& c) {
  if (!c.likeness) return 0.0;
  std::vector<Parameter> geometry;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < c.parameters.size(); ++i) {
    if (c.parameters[i].of_effect()) continue;
    geometry.push_back(c.parameters[i]);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  FitData data;
  data.measured = &measured;
  const Eigen::MatrixXd J = at_imagined_poses(cell, data, c.state, geometry);
  const Eigen::MatrixXd open = J * Eigen::MatrixXd(c.covariance(rows, rows));
  return open.cwiseProduct(J).sum() / static_cast<double>(J.rows());
}

/// The error of a correct model at new poses, in noise floors, if its predictions have this
/// variance.
double open_ratio(double variance_m2, const NoiseFloor& floor) {
  if (variance_m2 <= 0.0 || floor.sigma_m <= 0.0) return 1.0;
  return kOpenByChance * std::sqrt(1.0 + variance_m2 / (floor.sigma_m * floor.sigma_m));
}

/// Whether the held-out error cannot be judged: there are fewer coordinates than numbers, and the
/// arm may share none of these with the earlier one.
bool says_nothing(const Calibration& c, double coordinates) {
  return c.likeness && c.likeness->kind != Likeness::Kind::kSame &&
         coordinates < static_cast<double>(c.estimates.size());
}

/// Finds held-out poses far outside the scatter of the others. They still count in `held`.
void find_held_outliers(const Measurements& measured, const std::vector<int>& held, Fit& out) {
  const Rows3 error = residuals(measured, out.predicted_M);
  std::vector<double> norms;
  for (const int row : held) norms.push_back(error.row(row).norm());
  const StandingOut far = standing_out(norms, measured.usual_axes(), out.floor.sigma_m);
  for (const std::size_t i : far.which)
    out.held_outliers.push_back({.row = held[i],
                                 .error_m = norms[i],
                                 .times = far.times[i],
                                 .pose = measured.pose.empty() ? "" : measured.pose[held[i]]});
  out.held_without_outliers =
      stats_of(measured, out.predicted_M, without_outliers(held, out.held_outliers));
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
  // With folds every held-out pose is also fitted, so W-FIT-OUTLIERS names it already.
  if (!out.held_outliers.empty() && out.split.folds == 0)
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FIT-HELD-OUTLIERS",
         .message = fmt::format("held-out poses stand out; one line of the error table counts "
                                "them, the next leaves them out: {}",
                                named(measured, out.held_outliers)),
         .help = kHelp});
}

/// W-FIT-SETUP: set-ups of so few poses that none is held out; their accuracy is not known.
void remark_on_setups_without_held(const Cell& cell, const Measurements& measured, Fit& out) {
  if (measured.setup.empty()) return;
  std::set<int> judged;
  for (const int row : held_rows(out.split))
    judged.insert(measured.setup[static_cast<std::size_t>(row)]);
  std::vector<std::string> names;
  for (int k = 0; k < setup_count(cell.measurement); ++k)
    if (!judged.contains(k) && !of_artefact(cell.measurement, k))
      names.push_back(setup_name(cell.measurement, k));
  if (names.empty() || judged.empty()) return;
  out.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-FIT-SETUP",
       .message = fmt::format("no reading of set-up {} is held out: where its tracker and its "
                              "reflector are nobody checks",
                              fmt::join(names, ", ")),
       .help = "measure at least 10 poses in each set-up"});
}

/// Number of parameters of frame and target that a set-up does not share with an earlier one.
int own_numbers(const MeasurementSettings& settings, int setup) {
  const Setup rule = setup_rule(settings, setup);
  return (rule.fit_frame && frame_root(settings, setup) == setup ? 6 : 0) +
         (rule.fit_target && target_root(settings, setup) == setup ? 3 : 0);
}

/// W-FIT-SETUP-TIGHT: set-ups with hardly more coordinates than parameters of their own, which
/// adapt to any error of the readings.
void remark_on_tight_setups(const Cell& cell, const Measurements& measured, Fit& out) {
  if (measured.setup.empty()) return;
  const auto axes = std::count(measured.has_axis.begin(), measured.has_axis.end(), true);
  for (int k = 0; k < setup_count(cell.measurement); ++k) {
    const auto readings = std::count(measured.setup.begin(), measured.setup.end(), k);
    const int numbers = own_numbers(cell.measurement, k);
    if (of_artefact(cell.measurement, k)) continue;
    if (readings == 0 || numbers == 0 || axes * readings >= numbers + kSpareOfSetup) continue;
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FIT-SETUP-TIGHT",
         .message = fmt::format("set-up {} has {} for {} of its own (frame, reflector): these "
                                "fit whatever was read, and may be off by millimetres",
                                setup_name(cell.measurement, k),
                                counted_words(readings, "reading", "readings"),
                                counted_words(numbers, "number", "numbers")),
         .help = "measure at least 10 poses in each set-up, far apart"});
  }
}

/// W-FIT-SETUP-OPEN: set-ups whose readings do not determine where their tracker stands, because
/// there are only two of them or all lie in one line.
void remark_on_open_setups(const Cell& cell, const Measurements& measured, Fit& out) {
  if (measured.setup.empty()) return;
  for (int k = 0; k < setup_count(cell.measurement); ++k) {
    const std::string frame = frame_prefix(cell.measurement, k);
    std::vector<std::string> open;
    for (const std::string& name : out.calibration.held)
      if (name.starts_with(frame)) open.push_back(name);
    if (open.empty()) continue;
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FIT-SETUP-OPEN",
         .message = fmt::format("the readings of set-up {} do not tell where its tracker stands: "
                                "{} {} only guessed, and positions of that set-up are not to be "
                                "used",
                                setup_name(cell.measurement, k), fmt::join(open, ", "),
                                open.size() == 1 ? "is" : "are"),
         .help = "measure at least 3 poses of it, far apart and not in one line"});
  }
}

void remark_on_repeats_of_held(Fit& out) {
  if (out.split.repeats_of_held == 0) return;
  out.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-FIT-HELD-TWICE",
       .message = fmt::format("{} held out and {} not fitted: else these poses would vouch for "
                              "themselves",
                              counted_words(out.split.repeats_of_held, "row repeats a pose that is",
                                            "rows repeat poses that are"),
                              out.split.repeats_of_held == 1 ? "was" : "were"),
       .help = "hold out poses that are not fitted, all repeats of a pose on one side"});
}

void remark_on_marks(const Cell& cell, Fit& out) {
  if (!out.split.marked || cell.measurement.held_out.kind != HeldOutRule::Kind::kAuto) return;
  out.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-FIT-MARKED",
       .message = fmt::format(
           "the held-out poses are the {} that column 'set' marks as held",
           counted_words(static_cast<long long>(held_rows(out.split).size()), "row", "rows")),
       .help = "to let plumb choose instead: plumb fit --held-out 20%"});
}

/// 1 sigma of what the common scale of all lengths of the arm does at its reach [m].
double sigma_of_size(const Cell& cell, const Calibration& c) {
  const auto scale = common_scale(c, cell.fit.prior_m);
  return scale ? scale->sigma * reach(c.state.arm.calibrated) : 0.0;
}

/// Whether readings about artefacts leave the size of the arm open: no length was read, or those
/// that were read tell it less well than the tolerance.
bool size_is_unknown(const Cell& cell, const Calibration& c) {
  return lacks_length(cell) ||
         (has_artefacts(cell.measurement) && sigma_of_size(cell, c) > cell.tolerance_m);
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

Fit assemble(const Cell& stated, const Measurements& measured, Split split,
             const std::function<void(const std::string&)>& tell) {
  Fit out;
  out.orientations = judge_orientations(stated, measured);
  const Cell cell = with_orientations_as_judged(stated, out.orientations);
  out.split = std::move(split);
  if (measured.departure_B.rows() > 0) out.base = Base::kController;
  const std::vector<int> fit = fit_rows(out.split);
  const bool several = setup_count(cell.measurement) > 1;
  if (several && out.split.folds == 0) check_placed(cell, measured, fit, held_rows(out.split));
  if (tell && out.split.folds > 0)
    tell(fmt::format("step 1 of {}, all poses", out.split.folds + 1));
  FittedModel final_model = fit_on(cell, measured, fit);
  const Rows3 final_points = predict_points(final_model.calibration.state, measured);
  HeldPredictions predicted{final_points, final_points, final_points, {}};
  if (measured.has_orientation() && cell.measurement.sigma_rad)
    predicted.turned_G = turns_of_target(final_model.calibration.state, measured);
  const ArmState start = final_model.geometry_only;
  double open = out.split.folds > 0 ? 0.0 : left_open(cell, measured, final_model.calibration);
  for (int k = 0; k < out.split.folds; ++k) {
    if (tell) tell(fmt::format("step {} of {}, fold {}", k + 2, out.split.folds + 1, k + 1));
    const auto inside = fit_rows(out.split, k);
    if (several) check_placed(cell, measured, inside, held_rows(out.split, k));
    const FittedModel fitted = fit_on(cell, measured, inside, &start);
    open += left_open(cell, measured, fitted.calibration) / out.split.folds;
    predict_held(cell, measured, fitted, inside, held_rows(out.split, k), predicted);
  }
  if (out.split.folds == 0)
    predict_held(cell, measured, final_model, fit, held_rows(out.split), predicted);
  const auto held = held_rows(out.split);
  out.nominal_held = stats_of(measured, predicted.nominal, held);
  out.geometry_held = stats_of(measured, predicted.geometry, held);
  out.held = stats_of(measured, predicted.full, held);
  if (predicted.turned_G.size() > 0) {
    const Eigen::VectorXd turns = predicted.turned_G(held, Eigen::all).rowwise().norm();
    out.turn_held = summarise({turns.begin(), turns.end()});
  }
  out.fit = stats_of(measured, final_points, fit);
  out.predicted_M = std::move(predicted.full);
  out.turned_G = std::move(predicted.turned_G);
  out.floor = noise_floor(cell, measured, final_model.calibration.state);
  if (cell.measurement.sigma_rad) out.turn_floor = orientation_floor(stated, measured);
  out.calibration = std::move(final_model.calibration);
  find_held_outliers(measured, held, out);
  out.still = still_joints(cell, measured, fit);
  out.size_unknown = size_is_unknown(cell, out.calibration);
  const double coordinates = fitted_coordinates(measured, out.split);
  const double numbers = out.calibration.decided + out.calibration.series_dof;
  out.unavoidable_ratio =
      std::max(unavoidable_ratio(coordinates, numbers), open_ratio(open, out.floor));
  if (says_nothing(out.calibration, coordinates)) out.unavoidable_ratio = kAnyError;
  out.remarks = out.calibration.remarks;
  remark_on_outliers(measured, out);
  remark_on_repeats_of_held(out);
  remark_on_open_setups(cell, measured, out);
  remark_on_tight_setups(cell, measured, out);
  const Measurements fitted = pick(measured, without_outliers(fit, out.calibration.outliers));
  for (auto& remark : point_remarks(cell.measurement, fitted, out.calibration))
    out.remarks.push_back(std::move(remark));
  remark_on_setups_without_held(cell, measured, out);
  remark_on_marks(cell, out);
  remark_on_still_joints(out);
  if (auto remark = orientation_remark(out.orientations)) out.remarks.push_back(*std::move(remark));
  out.tree = std::move(final_model.tree);
  return out;
}

}  // namespace

Fit fit_cell(const Cell& cell, const Measurements& measured,
             const std::function<void(const std::string&)>& tell) {
  return assemble(cell, measured,
                  split_poses(measured, cell.measurement.held_out, cell.measurement.seed), tell);
}

Fit fit_all(const Cell& cell, const Measurements& measured) {
  Split split;
  split.fold.assign(measured.size(), -1);
  split.held.assign(measured.size(), false);
  split.used.assign(measured.size(), true);
  for (int i = 0; i < measured.size(); ++i) split.used[i] = measured.set[i] != SetMark::kIgnore;
  return assemble(cell, measured, std::move(split), {});
}

}  // namespace plumb::offline

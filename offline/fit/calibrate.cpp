// SPDX-License-Identifier: Apache-2.0
#include "fit/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "cell/earlier_arm.hpp"
#include "effects/fitted_laws.hpp"
#include "fit/calibration_covariance.hpp"
#include "fit/constants.hpp"
#include "fit/fit_judgement.hpp"
#include "fit/held_fit.hpp"
#include "fit/likeness_judgement.hpp"
#include "fit/pose_sense.hpp"
#include "fit/unknown_numbers.hpp"
#include "noise/weights.hpp"
#include "numbers/products.hpp"
#include "program/file.hpp"
#include "solve/constants.hpp"
#include "solve/descent.hpp"
#include "solve/evaluation.hpp"
#include "solve/frame_start.hpp"
#include "solve/many_rows.hpp"
#include "solve/odd_pose.hpp"
#include "solve/outliers.hpp"
#include "solve/parameter_subset.hpp"
#include "solve/placement.hpp"
#include "solve/prior_lines.hpp"
#include "solve/scaled_jacobian.hpp"
#include "solve/series_numbers.hpp"
#include "solve/series_solver.hpp"
#include "solve/solution_checks.hpp"
#include "solve/solver.hpp"
#include "solve/thinned_rows.hpp"
#include "solve/weak_direction_search.hpp"

namespace plumb::offline {
namespace {

// Identifiability that is asked for before the noise is known, and after.
constexpr Identifiability kCoarse{.min_independent_share = kCoarseIndependence, .max_std = 1.0};
constexpr Identifiability kFine{.min_independent_share = kIndependence, .max_std = 1.0};
constexpr Identifiability kRank{.min_independent_share = kIndependence};

ArmState nominal_state(const Cell& cell, const Measurements& measured) {
  ArmState state;
  state.arm.gravity = cell.gravity;
  state.arm.mechanics = mechanics_of(cell);
  state.arm.effects = bind_effects(cell, measured);
  state.arm.calibrated = cell.nominal;
  place_as_given(cell.measurement, state);
  return state;
}

FitData fit_data(const Cell& cell, const Measurements& measured, const std::vector<int>& rows) {
  FitData data;
  data.cell = &cell;
  data.measured = &measured;
  data.rows = rows;
  data.sigma_m = stated_sigma(cell, measured);
  // Readings scatter at least by the residual of the earlier run's model.
  if (cell.fit.earlier) data.sigma_m = data.sigma_m.cwiseMax(cell.fit.earlier->left_m);
  if (measured.has_orientation()) data.sigma_rad = cell.measurement.sigma_rad.value_or(0.0);
  return data;
}

Rows3 picked(const Rows3& all, const std::vector<int>& rows) { return all(rows, Eigen::all); }

void widen(FitData& data, double tau) {
  data.sigma_m = (data.sigma_m.array().square() + tau * tau).sqrt().matrix();
}

/// `state` with the arm's parameters that are held set back to nominal.
ArmState with_held_at_nominal(const ArmState& state, const ArmState& nominal,
                              const std::vector<Parameter>& candidates,
                              const std::vector<std::string>& held) {
  std::vector<Parameter> back;
  for (const auto& p : candidates)
    if (p.of_robot() && std::find(held.begin(), held.end(), p.name) != held.end())
      back.push_back(p);
  Eigen::VectorXd change(static_cast<Eigen::Index>(back.size()));
  for (std::size_t i = 0; i < back.size(); ++i)
    change(i) = value_of(nominal, back[i]) - value_of(state, back[i]);
  return moved(state, back, change);
}

bool holds(const std::vector<Parameter>& all, const std::string& name) {
  return std::any_of(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
}

/// `first`, then the other parameters of `all`. The parameters of the coarse fit are thus preferred
/// to parameters that act only through a small error of another one, as target.z of a SCARA acts
/// only through a tilt.
std::vector<Parameter> led_by(const std::vector<Parameter>& first,
                              const std::vector<Parameter>& all) {
  std::vector<Parameter> out = first;
  for (const auto& p : all)
    if (!holds(first, p.name)) out.push_back(p);
  return out;
}

/// Scatter of the residuals beyond the stated sigma, for a model with this number of parameters.
double excess_of(const FitData& data, const Solution& solution, std::size_t parameters) {
  const Measurements some = pick(*data.measured, data.rows);
  const Rows3 residual = residuals(some, predict_points(solution.state, some));
  return excess_sigma(some, residual, picked(data.sigma_m, data.rows),
                      static_cast<int>(parameters + std::lround(solution.series_dof)));
}

/// `stated` with its sigma widened by the scatter of the residuals beyond it. The prior of a series
/// of waves is weighed against that scatter, which in turn depends on the fitted series. So
/// `solution` is first replaced twice by a rough solution with the series on some of the rows.
FitData weighed_for_series(const FitData& stated, const ParameterSubset& subset,
                           Solution& solution) {
  const auto widened = [&] {
    FitData out = stated;
    out.series = true;
    widen(out, excess_of(stated, solution, subset.kept.size()));
    return out;
  };
  for (int pass = 0; pass < 2; ++pass) {
    FitData some = widened();
    some.rows = thinned(stated, kScatterRows);
    solution = solve(some, ArmState(solution.state), subset.kept, kSolvedRoughly);
  }
  return widened();
}

std::vector<Parameter> candidates_of(const Cell& cell, const FitData& data) {
  return calibration_candidates(cell, *data.measured, nominal_state(cell, *data.measured));
}

/// `arm` with so small a covariance that a fit keeps the numbers both arms share at their mean.
KnownArm pinned(KnownArm arm) {
  arm.covariance *= kPinned * kPinned;
  return arm;
}

Calibration summary(const FitData& data, const ArmState& nominal, const Solution& solution,
                    const ParameterSubset& subset) {
  const auto count = static_cast<Eigen::Index>(subset.kept.size());
  const Eigen::Index without_weak = solution.residual.size() - data.weak.weights.rows();
  // Directions that are held near nominal do not use up degrees of freedom of the readings.
  const auto dof = std::max<Eigen::Index>(
      1, solution.residual.size() - count - std::lround(solution.series_dof));
  const double sigma = data.sigma_m(data.rows.front(), 0);
  const Eigen::MatrixXd J =
      solution.marginal.size() > 0 ? triangle_of(solution.marginal) : solution.jacobian;
  Calibration out;
  out.sigma0 =
      std::sqrt(solution.residual.head(without_weak).squaredNorm() / static_cast<double>(dof));
  out.covariance = inverse_information(J) * std::pow(std::max(1.0, out.sigma0), 2);
  out.decided = static_cast<double>(count);
  out.calibrability = calibrability(sigma * sigma * gram_matrix(J), subset.kept);
  out.state = solution.state;
  out.estimates = estimates_of(solution.state, nominal, subset.kept, out.covariance);
  out.parameters = subset.kept;
  out.held = subset.held;
  out.series_dof = solution.series_dof;
  return out;
}

/// A first fit, before the scatter of the readings is known.
struct CoarseFit {
  FitData data;  // its rows are without the outliers
  ParameterSubset subset;
  Solution solution;
  std::vector<Outlier> outliers;

  double scatter() const {
    const LineTable table = data.line_table();
    return usual_scatter(
        comparable(deletion_distances(data, solution, subset.kept), table, table.most()),
        table.most());
  }
};

/// How many of the parameters have no prior from an earlier run.
std::size_t unknown_before(const FitData& data, const std::vector<Parameter>& parameters) {
  const auto& known = data.arm.names;
  return static_cast<std::size_t>(
      std::count_if(parameters.begin(), parameters.end(), [&](const Parameter& p) {
        return std::find(known.begin(), known.end(), p.name) == known.end();
      }));
}

/// With few poses, a fit of all parameters adapts to a bad reading and so hides it. With the
/// numbers held near those of the earlier arm it stands out. Takes such readings out of the data.
std::vector<Outlier> outliers_of_known_arm(CoarseFit& coarse) {
  const auto& earlier = coarse.data.cell->fit.earlier;
  // With many rows the usual search for outliers finds them.
  if (!earlier || is_many(coarse.data, coarse.subset.kept)) return {};
  FitData alike = coarse.data;
  alike.arm =
      known_within(kMuchLike, coarse.data, coarse.solution.state, coarse.subset.kept, *earlier);
  const std::size_t most = std::max<std::size_t>(1, alike.rows.size() / kOneOddOf);
  std::vector<Outlier> out;
  while (out.size() < most) {
    const Solution solution = solve(alike, coarse.solution.state, coarse.subset.kept);
    const auto odd = odd_pose(alike, solution);
    if (!odd) break;
    const int row = alike.rows[*odd];
    const Measurements one = pick(*alike.measured, {row});
    alike.rows.erase(alike.rows.begin() + static_cast<std::ptrdiff_t>(*odd));
    const double error = residuals(one, predict_points(solution.state, one)).row(0).norm();
    out.push_back({.row = row, .error_m = error, .times = 0.0});
  }
  coarse.data.rows = alike.rows;
  return out;
}

WeakDirections held_directions(const FitData& data, const ArmState& state,
                               const std::vector<Parameter>& parameters, HeldNear held) {
  return held == HeldNear::kAllDirections ? all_directions(data, state, parameters)
                                          : weak_directions(data, state, parameters);
}

CoarseFit coarse_from(const FitData& data, const ArmState& start,
                      const std::vector<Parameter>& candidates, HeldNear held) {
  CoarseFit out{.data = data, .subset = {}, .solution = {}, .outliers = {}};
  const ArmState nominal = nominal_state(*data.cell, *data.measured);
  ArmState placed = nominal;
  placed.X_MB = start.X_MB;
  placed.X_TG = start.X_TG;
  placed.length_m = start.length_m;
  placed.more = start.more;
  out.subset = identifiable_parameters(data, unhidden(placed), candidates, kCoarse, Size::kGiven);
  check_enough(data, unknown_before(data, out.subset.kept), candidates);
  out.data.weak = held_directions(data, unhidden(placed), out.subset.kept, held);
  out.solution.state = with_held_at_nominal(unhidden(start), nominal, candidates, out.subset.held);
  out.outliers = outliers_of_known_arm(out);
  const auto more = solve_without_outliers(out.data, out.subset.kept, out.solution);
  out.outliers.insert(out.outliers.end(), more.begin(), more.end());
  return out;
}

/// The best of the fits from all starts. Adds W-FIT-AMBIGUOUS if one with another frame is nearly
/// as good.
CoarseFit coarse_from_any(const FitData& data, const std::vector<ArmState>& starts,
                          const std::vector<Parameter>& candidates, HeldNear held,
                          std::vector<Problem>& remarks) {
  std::vector<CoarseFit> all;
  for (const auto& start : starts) all.push_back(coarse_from(data, start, candidates, held));
  if (all.size() == 1) return std::move(all.front());
  std::sort(all.begin(), all.end(),
            [](const CoarseFit& a, const CoarseFit& b) { return a.scatter() < b.scatter(); });
  const auto& [best, other] = std::pair(all[0].solution.state, all[1].solution.state);
  if (all[1].scatter() < kNearlyAsGood * all[0].scatter() &&
      turn_between(best, other) > kSameTurn_rad)
    remarks.push_back(ambiguous_frame(best, other));
  return std::move(all.front());
}

/// The parameters that the poses tell apart at `state`; of frame, target and arm only those that
/// they tell apart without effects. Effects make more of them observable in principle (a leaning
/// column shows the height of the reflector of a SCARA, a bumped tracker the direction of its
/// axes), but so weakly that the estimate may diverge along the product of both, and that the
/// uncertainty of the base frame would enter the corrected tool pose.
ParameterSubset fine_subset(const FitData& data, const ArmState& state,
                            const std::vector<Parameter>& candidates) {
  if (state.arm.effects.empty())
    return identifiable_parameters(data, state, candidates, kFine, Size::kGiven);
  ArmState bare = state;
  bare.arm.effects.clear();
  std::vector<Parameter> of_arm;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(of_arm),
               [](const Parameter& p) { return !p.of_effect(); });
  const auto shown = identifiable_parameters(data, bare, of_arm, kFine, Size::kGiven);
  std::vector<Parameter> left;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(left),
               [&](const Parameter& p) { return p.of_effect() || holds(shown.kept, p.name); });
  ParameterSubset out = identifiable_parameters(data, state, left, kFine, Size::kGiven);
  out.held.insert(out.held.end(), shown.held.begin(), shown.held.end());
  return out;
}

Problem unlike_sisters(double times) {
  return {
      .severity = Severity::kWarning,
      .code = "W-FIT-SISTERS",
      .message = fmt::format("this arm is unlike its sisters, {:.1f} times as far from their mean "
                             "as they are from each other: what they taught weighs little",
                             times),
      .help = "is it an arm of this model and batch? Else take prior_from out of cell.toml"};
}

/// N-FIT-EARLIER: names effects that the earlier run fitted and this cell does not list as it does.
/// They probably act in this arm, too.
void note_effects(const EarlierArm& earlier, const KnownArm& known, std::vector<Problem>& remarks) {
  std::set<std::string> lacking;
  for (const auto& number : earlier.numbers) {
    const std::string effect = number.name.substr(0, number.name.find('.'));
    if (number.of_effect && !effect.empty() && !is_measurement_law(find_fitted_law(effect)) &&
        std::find(known.names.begin(), known.names.end(), number.name) == known.names.end())
      lacking.insert(effect);
  }
  if (lacking.empty()) return;
  remarks.push_back({.severity = Severity::kNote,
                     .code = "N-FIT-EARLIER",
                     .message = fmt::format("{} fitted effects that this cell does not list as it "
                                            "does: {}",
                                            display_name(earlier.run), fmt::join(lacking, ", ")),
                     .help = "plumb add " + *lacking.begin()});
}

Problem has_little_in_common(const EarlierArm& earlier) {
  return {.severity = Severity::kWarning,
          .code = "W-FIT-EARLIER",
          .message = fmt::format("this arm has little in common with that of {}, whose numbers "
                                 "weigh little",
                                 display_name(earlier.run)),
          .help = "is it that arm, or one of its model and batch? Else fit without it"};
}

/// Replaces the uncertainty of the final fit, which held the shared numbers, by what was concluded
/// about them from both arms.
void add_likeness(const LikenessJudgement& judged, const EarlierArm& earlier, const FitData& data,
                  const Solution& solution, Calibration& out) {
  out.likeness = judged.likeness;
  out.known = judged.arm;
  out.decided += judged.decided - static_cast<double>(judged.arm.names.size());
  FitData readings = data;
  readings.arm = {};
  FitData some = readings;
  some.rows = thinned(readings, kManyRows);
  const Eigen::MatrixXd J = jacobian_for_all(readings, some, solution.state, out.parameters);
  out.covariance = covariance_with(judged.arm, J, out.parameters);
  for (std::size_t i = 0; i < out.estimates.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out.estimates[i].std = std::sqrt(std::max(0.0, out.covariance(at, at)));
  }
  note_effects(earlier, judged.arm, out.remarks);
  if (judged.likeness.kind == Likeness::Kind::kUnlike)
    out.remarks.push_back(has_little_in_common(earlier));
}

Calibration refined(const Cell& cell, const FitData& whole, CoarseFit coarse,
                    const std::vector<Parameter>& candidates, HeldNear held) {
  FitData data = whole;  // its sigma is the stated one
  const ArmState nominal = nominal_state(cell, *whole.measured);
  // An arm may be far from where the fit began, where the density was linear.
  data.touches = touch_density(*whole.measured, whole.rows, coarse.solution.state, candidates);
  data.rows = coarse.data.rows;
  std::optional<LikenessJudgement> judged;
  if (cell.fit.earlier) {
    judged = judge_likeness(data, coarse.solution.state, coarse.subset.kept, *cell.fit.earlier);
    data.arm = pinned(judged->arm);
    data.sigma_m *= judged->noise_times;
  } else {
    widen(data, excess_of(data, coarse.solution, coarse.subset.kept.size()));
  }
  // The coarse fit used only some of many rows; all of them tell more parameters apart.
  if (whole.rows.size() > std::size_t{kManyRows}) data.rows = whole.rows;
  const auto fine =
      fine_subset(data, coarse.solution.state, led_by(coarse.subset.kept, candidates));
  data.rows = whole.rows;
  Solution solution = std::move(coarse.solution);
  solution.state = with_held_at_nominal(solution.state, nominal, candidates, fine.held);
  // Weak directions depend on the noise of the instrument, not on effects that the model lacks.
  FitData stated = whole;
  stated.arm = data.arm;
  stated.touches = data.touches;
  data.weak = held_directions(stated, solution.state, fine.kept, held);
  const int coarse_iterations = solution.iterations;
  if (has_series(solution.state)) {
    stated.weak = data.weak;
    data = weighed_for_series(stated, fine, solution);
  }
  const auto outliers = solve_without_outliers(data, fine.kept, solution);
  check_converged(solution);
  check_meets(cell, data, solution);
  Calibration out = summary(data, nominal, solution, fine);
  out.outliers = outliers;
  if (judged) add_likeness(*judged, *cell.fit.earlier, data, solution, out);
  if (data.weak.weights.rows() > 0) out.remarks.push_back(held_near_nominal(data.weak, cell));
  const double unlike =
      PriorLines(data, solution.state, fine.kept).distance_from_sisters(solution.state);
  if (unlike > kUnlikeSisters) out.remarks.push_back(unlike_sisters(std::sqrt(unlike)));
  out.iterations = coarse_iterations + solution.iterations;
  data.touches = touch_density(*data.measured, data.rows, solution.state, candidates);
  out.rank = static_cast<int>(
      identifiable_parameters(data, solution.state, candidates, kRank).kept.size());
  return out;
}

/// Where a calibration starts, and what it may fit.
struct CalibrationStart {
  FitData data, even;  // even: all readings of the same weight, and only some of many rows
  std::vector<ArmState> states;
  std::vector<Parameter> candidates;
  UnknownNumbers unknown;
};

CalibrationStart start_of(const Cell& cell, const Measurements& measured,
                          const std::vector<int>& rows, const ArmState* start) {
  check_poses(measured, rows);
  CalibrationStart out;
  out.data = fit_data(cell, measured, rows);
  out.candidates = candidates_of(cell, out.data);
  check_enough(out.data, 0, out.candidates);
  // As long as the errors of the model exceed the noise, all readings have the same weight.
  out.even = out.data;
  out.even.sigma_m.setConstant(picked(out.data.sigma_m, rows).mean());
  // Of many rows, some are enough for a start and for the scatter.
  out.even.rows = thinned(out.even, kManyRows);
  const auto weigh_touches = [&](const ArmState& state) {
    out.even.touches = out.data.touches = touch_density(measured, rows, state, out.candidates);
  };
  if (start != nullptr)
    out.states.push_back(*start);
  else
    for (auto& placed : placements(out.even, nominal_state(cell, measured), out.candidates))
      out.states.push_back(std::move(placed.state));
  weigh_touches(out.states.front());
  if (cell.fit.earlier) {
    check_same_model(cell, *cell.fit.earlier);
    out.unknown =
        unknown_numbers(*cell.fit.earlier, cell, out.even, out.states.front(), out.candidates);
    out.candidates = out.unknown.candidates;
    out.even.arm = out.data.arm =
        known_within(kHardlyLike, out.data, out.states.front(), out.candidates, *cell.fit.earlier);
  }
  return out;
}

/// A calibration that may have ended in another arm: check_same_arm tells.
Calibration calibrated_with(const Cell& cell, const CalibrationStart& start, HeldNear held) {
  std::vector<ArmState> states = start.states;
  std::vector<Parameter> candidates = start.candidates;
  std::vector<Problem> remarks;
  CoarseFit coarse = coarse_from_any(start.even, states, candidates, held, remarks);
  const auto open = reflector_left_open(start.data, start.unknown, coarse.subset.held);
  if (!open.empty()) {
    for (auto& state : states) state = with_reflector_of(*cell.fit.earlier, state, open);
    std::erase_if(candidates, [&](const Parameter& p) { return holds(open, p.name); });
    remarks = {reflector_as_earlier(*cell.fit.earlier, open)};
    coarse = coarse_from_any(start.even, states, candidates, held, remarks);
  }
  check_placed_by_poses(start.data, start.unknown, coarse.subset.held);
  Calibration out = refined(cell, start.data, std::move(coarse), candidates, held);
  const auto& redundant = start.unknown.redundant;
  out.held.insert(out.held.end(), redundant.begin(), redundant.end());
  for (const auto& p : open) out.held.push_back(p.name);
  warn_of_far_parameters(cell, out, remarks);
  warn_of_impossible_effects(out, remarks);
  out.remarks.insert(out.remarks.begin(), remarks.begin(), remarks.end());
  return out;
}

Calibration calibrated(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                       const ArmState* start) {
  const CalibrationStart from = start_of(cell, measured, rows, start);
  return held_if_it_wanders(from.data,
                            [&](HeldNear held) { return calibrated_with(cell, from, held); });
}

Calibration calibrated_near(const Cell& cell, const Measurements& measured,
                            const std::vector<int>& rows, const ArmState& start,
                            const Calibration& from, HeldNear held) {
  FitData stated = fit_data(cell, measured, without_outliers(rows, from.outliers));
  stated.arm = from.known;
  std::vector<Parameter> candidates;
  for (const auto& p : candidates_of(cell, stated))
    if (p.of_effect() || holds(from.parameters, p.name)) candidates.push_back(p);
  stated.touches = touch_density(measured, rows, start, candidates);
  Solution solution = evaluate(stated, unhidden(start), {});
  FitData data = stated;
  widen(data, excess_of(data, solution, candidates.size()));
  const auto subset =
      identifiable_parameters(data, solution.state, candidates, kFine, Size::kGiven);
  data.weak = held_directions(stated, solution.state, subset.kept, held);
  FitData weakly_held = stated;
  weakly_held.weak = data.weak;
  if (has_series(solution.state)) {
    data = weighed_for_series(weakly_held, subset, solution);
  } else {
    // This solution only gives the scatter of the model and a start for all rows.
    data.rows = thinned(stated, kScatterRows);
    solution = solve(data, ArmState(solution.state), subset.kept, kSolvedRoughly);
    data = weakly_held;
    widen(data, excess_of(data, solution, subset.kept.size()));
  }
  auto outliers = solve_without_outliers(data, subset.kept, solution);
  check_converged(solution);
  Calibration out = summary(data, nominal_state(cell, measured), solution, subset);
  out.outliers = from.outliers;
  out.outliers.insert(out.outliers.end(), outliers.begin(), outliers.end());
  out.rank = from.rank;
  out.iterations = solution.iterations;
  return out;
}

}  // namespace

Calibration calibrate(const Cell& cell, const Measurements& measured,
                      const std::vector<int>& rows) {
  return calibrated(cell, measured, rows, nullptr);
}

Calibration calibrate_from(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start) {
  return calibrated(cell, measured, rows, &start);
}

Calibration calibrate_near(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start,
                           const Calibration& from) {
  return held_if_it_is_lost(
      [&](HeldNear held) { return calibrated_near(cell, measured, rows, start, from, held); });
}

std::vector<Estimate> estimates_of(const ArmState& state, const ArmState& nominal,
                                   const std::vector<Parameter>& parameters,
                                   const Eigen::MatrixXd& covariance) {
  std::vector<Estimate> out;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    out.push_back(
        {.name = p.name,
         .is_length = p.is_length(),
         .of_robot = p.of_robot(),
         .unit = p.of_effect() ? effect_parameter(state.arm, p.joint, p.component).unit : "",
         .value = value_of(state, p),
         .nominal = value_of(nominal, p),
         .std = std::sqrt(std::max(0.0, covariance(i, i)))});
  }
  return out;
}

std::vector<Parameter> calibration_candidates(const Cell& cell, const Measurements& measured,
                                              const ArmState& state) {
  const bool turns = measured.has_orientation() && cell.measurement.sigma_rad.value_or(0.0) > 0.0;
  auto out = candidate_parameters(cell, turns ? Orientation::kUsed : Orientation::kIgnored);
  // The amplitudes of a series of waves are fitted as well, but are not listed as parameters.
  for (const auto& p : effect_parameters(state.arm))
    if (!is_amplitude_of_series(state.arm, p)) out.push_back(p);
  return out;
}

ArmState place_nominal(const Cell& cell, const Measurements& measured,
                       const std::vector<int>& rows) {
  FitData data = fit_data(cell, measured, rows);
  data.sigma_m.setConstant(picked(data.sigma_m, rows).mean());
  return place(data, nominal_state(cell, measured), candidates_of(cell, data)).state;
}

}  // namespace plumb::offline

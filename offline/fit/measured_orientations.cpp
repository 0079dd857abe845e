// SPDX-License-Identifier: Apache-2.0
#include "fit/measured_orientations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "arm/arm_state.hpp"
#include "arm/effect_binding.hpp"
#include "arm/measured_arm.hpp"
#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "fit/constants.hpp"
#include "noise/orientation_floor.hpp"
#include "numbers/quantile.hpp"
#include "numbers/rotation_fit.hpp"
#include "solve/constants.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

using Kind = MeasuredOrientations::Kind;

/// The scatter about a fit of both is found by at most so many fits, until its relative change is
/// this small.
constexpr double kScatterSettled = 0.1;
constexpr int kPasses = 5;

/// The orientations of the reflector by a model of the arm, as products frame * of_tool * target.
struct ToolTurns {
  std::vector<Matrix3> of_tool;          // per row, in the base frame
  std::vector<Matrix3> frame, target;    // per set-up
  std::vector<int> frame_of, target_of;  // per row

  std::size_t size() const { return of_tool.size(); }
  Matrix3 at(std::size_t i) const { return frame[frame_of[i]] * of_tool[i] * target[target_of[i]]; }
};

ToolTurns tool_turns(const ArmState& state, const Measurements& at) {
  const MeasuredArm arm(state.arm);
  const auto sensors = temperature_names(state.arm);
  ToolTurns out;
  for (int k = 0; k < state.setups(); ++k) {
    out.frame.push_back(from_pose(state.frame(k)).R);
    out.target.push_back(from_pose(state.target(k)).R);
  }
  for (Eigen::Index i = 0; i < at.q.rows(); ++i) {
    const int setup = setup_of(at, i);
    const MeasuredContext context = context_of(at, i, sensors, from_pose(state.frame(setup)));
    out.of_tool.push_back(
        arm.predict({at.q.row(i).data(), static_cast<std::size_t>(at.q.cols())}, context).X_BT.R);
    out.frame_of.push_back(state.frame_of(setup));
    out.target_of.push_back(state.target_of(setup));
  }
  return out;
}

std::vector<double> distances(const ToolTurns& turns, const std::vector<Matrix3>& read) {
  std::vector<double> out;
  for (std::size_t i = 0; i < turns.size(); ++i)
    out.push_back(rotation_vector(read[i] * turns.at(i).transpose()).norm());
  return out;
}

/// Robust standard deviation of the error per axis, from the median.
double scatter(const ToolTurns& turns, const std::vector<Matrix3>& read) {
  return sigma_of_angles(distances(turns, read));
}

/// Fits the rotations of the targets to the readings, in the second round without rows that are far
/// from the others.
void turn_targets(ToolTurns& turns, const std::vector<Matrix3>& read) {
  constexpr double kFar = 4.0;  // medians; normal errors do not reach it
  for (int round = 0; round < 2; ++round) {
    const auto off = distances(turns, read);
    const double most = round == 0 ? M_PI : kFar * median(off);
    std::map<int, Matrix3> sum;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      if (off[i] > most) continue;
      auto [at, fresh] = sum.try_emplace(turns.target_of[i], Matrix3::Zero());
      at->second +=
          turns.of_tool[i].transpose() * turns.frame[turns.frame_of[i]].transpose() * read[i];
    }
    for (const auto& [target, total] : sum) turns.target[target] = nearest_rotation(total);
  }
}

/// Fits the rotations of the frames to the readings.
void turn_frames(ToolTurns& turns, const std::vector<Matrix3>& read) {
  std::map<int, Matrix3> sum;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    auto [at, fresh] = sum.try_emplace(turns.frame_of[i], Matrix3::Zero());
    at->second += read[i] * (turns.of_tool[i] * turns.target[turns.target_of[i]]).transpose();
  }
  for (const auto& [frame, total] : sum) turns.frame[frame] = nearest_rotation(total);
}

/// Usual error per axis if the rotations of frames and targets are fitted to the readings.
double freely_turned(ToolTurns turns, const std::vector<Matrix3>& read) {
  constexpr int kRounds = 20;
  double out = M_PI;
  ToolTurns in_base = turns;
  for (Matrix3& frame : in_base.frame) frame.setIdentity();
  for (ToolTurns* start : {&turns, &in_base}) {
    for (int i = 0; i < kRounds; ++i) {
      turn_targets(*start, read);
      turn_frames(*start, read);
    }
    turn_targets(*start, read);
    out = std::min(out, scatter(*start, read));
  }
  return out;
}

double largest_turn(const std::vector<Matrix3>& all) {
  double out = 0.0;
  for (const Matrix3& one : all)
    out = std::max(out, rotation_vector(one * all.front().transpose()).norm());
  return out;
}

Cell weighing(const Cell& cell, std::optional<double> sigma_rad) {
  Cell out = cell;
  out.measurement.sigma_rad = sigma_rad;
  return out;
}

double points_error(const ArmState& state, const Measurements& measured) {
  const Rows3 error = residuals(measured, predict_points(state, measured));
  const Eigen::VectorXd each = error.rowwise().norm();
  return median({each.begin(), each.end()});
}

class OrientationTest {
 public:
  OrientationTest(const Cell& cell, const Measurements& measured,
                  const std::vector<OrientationInterpretation>& others)
      : cell_(cell),
        measured_(measured),
        others_(others),
        rows_(static_cast<std::size_t>(measured.size())),
        labelled_(rotations_of(measured.quat_M)) {
    std::iota(rows_.begin(), rows_.end(), 0);
    out_.stated = cell.measurement.sigma_rad.has_value();
    out_.kind = Kind::kUnjudged;
  }

  MeasuredOrientations judge() {
    const auto by_points = fitted(measured_, std::nullopt);
    if (!by_points) return out_;
    arm_ = tool_turns(*by_points, measured_);
    points_error_ = points_error(*by_points, measured_);
    out_.labelled_rad = out_.left_rad = left(arm_, labelled_);
    if (is_constant())
      out_.kind = Kind::kConstant;
    else if (!is_nominal(measured_) && !is_meant_otherwise())
      weigh();
    return out_;
  }

 private:
  std::optional<ArmState> fitted(const Measurements& measured,
                                 std::optional<double> sigma_rad) const {
    try {
      return calibrate(weighing(cell_, sigma_rad), measured, rows_).state;
    } catch (const Failure&) {
      return std::nullopt;
    }
  }

  /// Error per axis that a fit would leave. The rotation of a reflector whose place is given is not
  /// fitted.
  double left(ToolTurns turns, const std::vector<Matrix3>& read) const {
    if (cell_.measurement.fit_target) turn_targets(turns, read);
    return scatter(turns, read);
  }

  bool is_constant() const {
    return largest_turn(labelled_) < kSameOrientation_rad &&
           largest_turn(arm_.of_tool) > kTurns_rad;
  }

  /// Whether the orientations follow the nominal arm although the points do not.
  bool is_nominal(const Measurements& measured) {
    const std::vector<Matrix3> read = rotations_of(measured.quat_M);
    const double against_nominal = freely_turned(nominal_turns(), read);
    const double against_arm = freely_turned(arm_, read);
    if (against_arm < kRounding_rad || against_nominal > kCopied * against_arm) return false;
    // If they are far off, they are known to harm a fit without trying it.
    if (left(arm_, read) < kMeant_rad && !harms(measured, std::max(against_nominal, kRounding_rad)))
      return false;
    out_.kind = Kind::kNominal;
    out_.left_rad = against_arm;
    return true;
  }

  ToolTurns nominal_turns() const {
    ArmState nominal;
    nominal.arm.calibrated = cell_.nominal;
    for (int k = 1; k < static_cast<int>(arm_.frame.size()); ++k)
      nominal.more.push_back({k, k, {}, {}});
    ToolTurns out = arm_;
    out.of_tool = tool_turns(nominal, measured_).of_tool;
    return out;
  }

  /// Whether a fit with orientations of this sigma misses the points by far more than one without.
  bool harms(const Measurements& measured, double sigma_rad) const {
    const auto both = fitted(measured, sigma_rad);
    return !both || points_error(*both, measured) > kHarm * points_error_;
  }

  /// Whether another interpretation of the columns or another frame explains them, or nothing does.
  bool is_meant_otherwise() {
    const double stated = cell_.measurement.sigma_rad.value_or(0.0);
    if (out_.labelled_rad < std::max(kMisread_rad, kAsStatedTimes * stated)) return false;
    const double most = std::min(kMeant_rad, kClearlyLess * out_.labelled_rad);
    std::vector<double> each;
    double best = M_PI;
    for (const auto& other : others_) {
      each.push_back(left(arm_, rotations_of(other.quat_M)));
      best = std::min(best, each.back());
    }
    if (best < most)
      take_simplest_of(each, best);
    else if (const double turned = freely_turned(arm_, labelled_); turned < most)
      out_.kind = Kind::kTurned, out_.left_rad = turned;
    else if (out_.labelled_rad > kNoMeasurement_rad)
      out_.kind = Kind::kUnexplained;
    return out_.kind != Kind::kUnjudged;
  }

  void take_simplest_of(const std::vector<double>& each, double best) {
    double changes = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < each.size(); ++i) {
      if (each[i] > kAlike * best + kRounding_rad || others_[i].changes > changes) continue;
      if (others_[i].changes < changes) out_.interpretations.clear();
      changes = others_[i].changes;
      out_.interpretations.push_back(static_cast<int>(i));
    }
    out_.kind = Kind::kOtherwise;
    const Rows4& quat = others_[static_cast<std::size_t>(out_.interpretations.front())].quat_M;
    Measurements meant = measured_;
    meant.quat_M = quat;
    if (is_nominal(meant)) return;
    out_.left_rad = about_both(meant, best, kRounding_rad).scatter_rad;
  }

  struct FitOfBoth {
    double scatter_rad;  // of the orientations
    double points_m;     // error of the points
  };

  /// Scatter of the orientations about an arm that is fitted to points and orientations, until it
  /// is below `enough`. Starts from `sigma`, the scatter about the arm of the points alone; that is
  /// an upper bound, because the points may not determine a wrist that orientations show.
  FitOfBoth about_both(const Measurements& measured, double sigma, double enough) const {
    const std::vector<Matrix3> read = rotations_of(measured.quat_M);
    FitOfBoth out{sigma, points_error_};
    for (int pass = 0; pass < kPasses && out.scatter_rad > enough; ++pass) {
      const auto both = fitted(measured, out.scatter_rad);
      if (!both) break;
      const double before = std::exchange(out.scatter_rad, left(tool_turns(*both, measured), read));
      out.points_m = points_error(*both, measured);
      if (std::abs(out.scatter_rad - before) < kScatterSettled * before) break;
    }
    return out;
  }

  void weigh() {
    const double stated = cell_.measurement.sigma_rad.value_or(0.0);
    const double enough = std::max(kAsStatedTimes * stated, kRounding_rad);
    out_.kind = Kind::kGood;
    if (out_.stated && out_.labelled_rad <= enough) return;
    const FitOfBoth both = about_both(measured_, out_.labelled_rad, enough);
    out_.left_rad = both.scatter_rad;
    if (out_.stated && both.scatter_rad <= enough) return;
    if (both.points_m > kHarm * points_error_) out_.kind = Kind::kContradict;
    if (!out_.stated || out_.kind == Kind::kContradict) return;
    out_.times = both.scatter_rad / stated;
    const auto repeats = orientation_scatter(measured_, measured_.replicate_group);
    out_.kind = repeats && *repeats <= enough ? Kind::kMissed : Kind::kScattered;
  }

  const Cell& cell_;
  const Measurements& measured_;
  const std::vector<OrientationInterpretation>& others_;
  std::vector<int> rows_;
  std::vector<Matrix3> labelled_;
  ToolTurns arm_;
  double points_error_ = 0.0;
  MeasuredOrientations out_;
};

}  // namespace

bool MeasuredOrientations::fit_to_use() const {
  return kind == Kind::kNone || kind == Kind::kUnjudged || kind == Kind::kGood ||
         kind == Kind::kScattered || kind == Kind::kMissed;
}

std::vector<int> rows_to_judge(const Measurements& measured) {
  std::vector<int> used;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set[static_cast<std::size_t>(i)] != SetMark::kIgnore) used.push_back(i);
  return thinned(measured, used, kJudgedRows);
}

MeasuredOrientations judge_orientations(const Cell& cell, const Measurements& measured,
                                        const std::vector<OrientationInterpretation>& others) {
  if (!measured.has_orientation()) return {};
  MeasuredOrientations unjudged;
  unjudged.kind = Kind::kUnjudged;
  unjudged.stated = cell.measurement.sigma_rad.has_value();
  if (measured.size() < kFewestJudged) return unjudged;
  return OrientationTest(cell, measured, others).judge();
}

MeasuredOrientations judge_orientations(const Cell& cell, const Measurements& measured) {
  if (!measured.has_orientation()) return {};
  return judge_orientations(cell, pick(measured, rows_to_judge(measured)), {});
}

Cell with_orientations_as_judged(const Cell& cell, const MeasuredOrientations& judged) {
  Cell out = cell;
  if (!judged.fit_to_use())
    out.measurement.sigma_rad.reset();
  else if (judged.times)
    out.measurement.sigma_rad = judged.left_rad;
  return out;
}

Cell as_judged(const Cell& cell, const Measurements& measured) {
  if (!cell.measurement.sigma_rad) return cell;
  return with_orientations_as_judged(cell, judge_orientations(cell, measured));
}

}  // namespace plumb::offline

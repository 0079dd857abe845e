// SPDX-License-Identifier: Apache-2.0
#include "fit/measured_orientations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "arm/arm_state.hpp"
#include "arm/effect_binding.hpp"
#include "arm/measured_arm.hpp"
#include "arm/predicted_points.hpp"
#include "cell/group_rows.hpp"
#include "fit/calibrate.hpp"
#include "numbers/quantile.hpp"
#include "numbers/rotation_fit.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

using Kind = MeasuredOrientations::Kind;

constexpr int kJudgedRows = 500;  // tell a scatter to 4 %, and cost less than the fit itself
constexpr int kFewestRows = 6;
constexpr double kMedianOf3 = 1.5382;       // of the length of three unit normals
constexpr double kAsStatedTimes = 2.0;      // the stated error: not worth a word
constexpr double kClearlyLess = 0.2;        // of the error as labelled: another reading explains it
constexpr double kMeant_rad = 20e-3;        // the most that a right reading leaves
constexpr double kMisread_rad = 5e-3;       // the least that a wrong one does
constexpr double kNoMeasurement_rad = 0.1;  // more than any instrument errs by
constexpr double kAlike = 1.5;              // times the best: as good
constexpr double kCopied = 0.1;             // of the error against the arm that the points give
constexpr double kRounding_rad = 5e-6;
constexpr double kStill_rad = 1e-5;  // between orientations that are the same
constexpr double kMoves_rad = 0.02;  // between orientations of an arm that turns its tool
constexpr double kHarm = 1.5;        // times the error of the points without orientations
constexpr double kSettled = 0.1;     // relative change of the scatter
constexpr int kPasses = 5;
constexpr std::size_t kFewestRepeats = 5;

/// Where an arm says that the reflector points, in parts: frame * of_tool * target.
struct ToolTurns {
  std::vector<Matrix3> of_tool;          // per row, in the base frame
  std::vector<Matrix3> frame, target;    // per set-up
  std::vector<int> frame_of, target_of;  // per row

  std::size_t size() const { return of_tool.size(); }
  Matrix3 at(std::size_t i) const { return frame[frame_of[i]] * of_tool[i] * target[target_of[i]]; }
};

std::vector<Matrix3> rotations_of(const Rows4& quat) {
  std::vector<Matrix3> out;
  for (const auto& q : quat.rowwise()) out.push_back(from_pose({{}, {q(0), q(1), q(2), q(3)}}).R);
  return out;
}

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

/// Usual error per axis, which a few wrong rows do not change.
double scatter(const ToolTurns& turns, const std::vector<Matrix3>& read) {
  return median(distances(turns, read)) / kMedianOf3;
}

/// The targets turned so that they agree best, without the rows that are far from the rest.
void turn_targets(ToolTurns& turns, const std::vector<Matrix3>& read) {
  constexpr double kFar = 4.0;
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

/// The same of the frames.
void turn_frames(ToolTurns& turns, const std::vector<Matrix3>& read) {
  std::map<int, Matrix3> sum;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    auto [at, fresh] = sum.try_emplace(turns.frame_of[i], Matrix3::Zero());
    at->second += read[i] * (turns.of_tool[i] * turns.target[turns.target_of[i]]).transpose();
  }
  for (const auto& [frame, total] : sum) turns.frame[frame] = nearest_rotation(total);
}

/// Usual error where any constant turn before and behind is allowed.
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

/// Usual difference per axis between repeats of a pose; none if there are few.
std::optional<double> scatter_of_repeats(const Measurements& measured,
                                         const std::vector<Matrix3>& read) {
  std::vector<int> all(read.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> off;
  visit_groups(measured.replicate_group, std::move(all), [&](std::span<const int> rows) {
    for (std::size_t k = 1; k < rows.size(); k += 2)
      off.push_back(rotation_vector(read[rows[k]] * read[rows[k - 1]].transpose()).norm() /
                    M_SQRT2);
  });
  if (off.size() < kFewestRepeats) return std::nullopt;
  return median(off) / kMedianOf3;
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

class Judge {
 public:
  Judge(const Cell& cell, const Measurements& measured,
        const std::vector<OrientationReading>& others)
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

  /// As a fit has them: a reflector that is given does not turn in the tool.
  double left(ToolTurns turns, const std::vector<Matrix3>& read) const {
    if (cell_.measurement.fit_target) turn_targets(turns, read);
    return scatter(turns, read);
  }

  bool is_constant() const {
    return largest_turn(labelled_) < kStill_rad && largest_turn(arm_.of_tool) > kMoves_rad;
  }

  /// They follow the nominal arm, and the points do not.
  bool is_nominal(const Measurements& measured) {
    const std::vector<Matrix3> read = rotations_of(measured.quat_M);
    const double against_nominal = freely_turned(nominal_turns(), read);
    const double against_arm = freely_turned(arm_, read);
    if (against_arm < kRounding_rad || against_nominal > kCopied * against_arm) return false;
    // So far off, they harm without a trial.
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

  /// With orientations of that weight the arm misses its points.
  bool harms(const Measurements& measured, double sigma_rad) const {
    const auto both = fitted(measured, sigma_rad);
    return !both || points_error(*both, measured) > kHarm * points_error_;
  }

  /// Another reading of the columns, or another frame, explains them.
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
      if (others_[i].changes < changes) out_.readings.clear();
      changes = others_[i].changes;
      out_.readings.push_back(static_cast<int>(i));
    }
    out_.kind = Kind::kOtherwise;
    const Rows4& quat = others_[static_cast<std::size_t>(out_.readings.front())].quat_M;
    Measurements meant = measured_;
    meant.quat_M = quat;
    if (is_nominal(meant)) return;
    out_.left_rad = about_both(meant, best, kRounding_rad).scatter_rad;
  }

  struct Both {
    double scatter_rad;
    double points_m;
  };

  /// How much they scatter about an arm that fits both, if not by less than `enough`. The points
  /// alone may leave a wrist open that orientations show, so the scatter about theirs is the most
  /// that it can be.
  Both about_both(const Measurements& measured, double sigma, double enough) const {
    const std::vector<Matrix3> read = rotations_of(measured.quat_M);
    Both out{sigma, points_error_};
    for (int pass = 0; pass < kPasses && out.scatter_rad > enough; ++pass) {
      const auto both = fitted(measured, out.scatter_rad);
      if (!both) break;
      const double before = std::exchange(out.scatter_rad, left(tool_turns(*both, measured), read));
      out.points_m = points_error(*both, measured);
      if (std::abs(out.scatter_rad - before) < kSettled * before) break;
    }
    return out;
  }

  void weigh() {
    const double stated = cell_.measurement.sigma_rad.value_or(0.0);
    const double enough = std::max(kAsStatedTimes * stated, kRounding_rad);
    out_.kind = Kind::kGood;
    if (out_.stated && out_.labelled_rad <= enough) return;
    const Both both = about_both(measured_, out_.labelled_rad, enough);
    out_.left_rad = both.scatter_rad;
    if (out_.stated && both.scatter_rad <= enough) return;
    if (both.points_m > kHarm * points_error_) out_.kind = Kind::kContradict;
    if (!out_.stated || out_.kind == Kind::kContradict) return;
    out_.times = both.scatter_rad / stated;
    const auto repeats = scatter_of_repeats(measured_, labelled_);
    out_.kind = repeats && *repeats <= enough ? Kind::kMissed : Kind::kScattered;
  }

  const Cell& cell_;
  const Measurements& measured_;
  const std::vector<OrientationReading>& others_;
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
                                        const std::vector<OrientationReading>& others) {
  if (!measured.has_orientation()) return {};
  MeasuredOrientations unjudged;
  unjudged.kind = Kind::kUnjudged;
  unjudged.stated = cell.measurement.sigma_rad.has_value();
  if (measured.size() < kFewestRows) return unjudged;
  return Judge(cell, measured, others).judge();
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "diagnose/whitened_fit.hpp"
#include "effects/descriptor.hpp"

namespace plumb::offline {

/// Structure that belongs to no law of the library, in words.
struct Pattern {
  std::string subject;                  // "joint 5", "the tool frame"
  std::string words;                    // "depends on q4 and q6 together"
  std::vector<std::string> depends_on;  // "q4", "t", "temp_base"
  double harmonic = 0.0;                // 0: none
  bool slow = false;                    // moves with time, a temperature or another slow reading
  int joint = -1;                       // the one that errs, zero-based; -1: the base or the tool
  bool empty() const { return subject.empty(); }
};

/// Subjects of patterns that belong to no joint.
inline constexpr const char* kTheBase = "the base";
inline constexpr const char* kTheTool = "the tool frame";

/// Something that may be missing from the model: how it would move the measured point, per typical
/// size. Either functions of the pose that turn or shift one joint, or as many functions for each
/// of several joints, or motions of the point itself.
struct Regressor {
  EffectEntry entry;  // of the library, as it would stand in the cell; no name: a pattern
  Pattern pattern;
  int joint = -1;              // the one that moves; -1: `columns` are motions of the point
  std::vector<int> joints;     // of a series, each with its share of the columns; else empty
  Eigen::MatrixXd columns;     // shape (poses, b) with joints, else (lines, b)
  Eigen::VectorXd typical;     // SI value of the parameter of each column that counts as 1
  std::vector<int> members;    // place of each column among the effect's parameters
  std::vector<bool> positive;  // columns whose size cannot be negative; empty: none
  std::vector<double> after_rows = {};  // of a part that moved several times: each column's move
  bool of_library() const { return !entry.name.empty(); }
};

/// Motions of a regressor, whitened, shape (lines, b).
Eigen::MatrixXd motions(const WhitenedFit& whitened, const Regressor& regressor);

/// The motion with these sizes, shape (lines,).
Eigen::VectorXd motion(const WhitenedFit& whitened, const Regressor& regressor,
                       const Eigen::VectorXd& theta);

using RegressorVisitor = std::function<void(const Regressor&)>;

/// Every law of the library but those in `not_testable`, joint by joint, with its non-linear
/// parameters on a grid. Nothing is visited twice; columns live only during the visit.
void visit_library(const WhitenedFit& whitened, const std::vector<std::string>& not_testable,
                   const RegressorVisitor& visit);

/// How the best value on the grid of an option is refined, which differs where its joints slide.
/// Null: the grid is fine enough.
const Refinement* refinement_of(const Cell& cell, const EffectEntry& entry);

/// How far a joint travels over the fit poses [rad] or [m].
double travel_of(const WhitenedFit& whitened, int joint);

/// One regressor of the library again, with other constants.
Regressor library_regressor(const WhitenedFit& whitened, const EffectEntry& entry);

/// Motions of a law under other loads than those of the whitened fit, per unit of each of its
/// parameters, whitened, shape (lines, parameters).
Eigen::MatrixXd motions_under(const WhitenedFit& whitened, const EffectEntry& entry,
                              const std::vector<Loads>& loads);

/// Waves of one joint at these cycles a turn, together.
Regressor ripple_regressor(const WhitenedFit& whitened, int joint,
                           const std::vector<double>& cycles);

/// Wave numbers that a scan tries at a joint, in steps that its range can tell apart; behind these
/// stand single ones. Usual: up to 40 cycles a turn, whole numbers of slow waves from 3 on, and
/// once and twice a turn of the motor if the gear ratio is given; fast: from there to 200, and all
/// those of the motor.
std::vector<double> ripple_grid(const WhitenedFit& whitened, int joint);
std::vector<double> fast_ripple_grid(const WhitenedFit& whitened, int joint);

/// Largest torque on a joint at the poses [N m].
double largest_torque(const WhitenedFit& whitened, int joint);

/// The part that a step says moved, moving as `shape` says instead, pose by pose.
Regressor pattern_of_part(const WhitenedFit& whitened, const EffectEntry& step, Pattern pattern,
                          const Eigen::ArrayXd& shape);

/// Visits generic patterns, so that an error that no law explains is not attributed to one.
void visit_patterns(const WhitenedFit& whitened, const RegressorVisitor& visit);

}  // namespace plumb::offline

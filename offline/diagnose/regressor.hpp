// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "diagnose/whitened_fit.hpp"

namespace plumb::offline {

/// Structure that belongs to no law of the library, in words.
struct Pattern {
  std::string subject;                  // "joint 5", "the tool frame"
  std::string words;                    // "depends on q4 and q6 together"
  std::vector<std::string> depends_on;  // "q4", "t", "temp_base"
  double harmonic = 0.0;                // 0: none
  bool empty() const { return subject.empty(); }
};

/// Something that may be missing from the model: how it would move the measured point, per typical
/// size. Either a function of the pose times one joint, or any motion.
struct Regressor {
  EffectEntry entry;  // of the library, as it would stand in the cell; no name: a pattern
  Pattern pattern;
  int joint = -1;              // `columns` multiply its motion; -1: they are motions themselves
  Eigen::MatrixXd columns;     // (poses, b) times a joint, or (lines, b)
  Eigen::VectorXd typical;     // SI value of each column's parameter that makes it 1
  std::vector<int> members;    // place of each column among the effect's parameters
  std::vector<bool> positive;  // columns whose size cannot be negative; empty: none
  bool of_library() const { return !entry.name.empty(); }
};

/// Motions of a regressor, whitened, shape (lines, b).
Eigen::MatrixXd motions(const WhitenedFit& whitened, const Regressor& regressor);

using RegressorVisitor = std::function<void(const Regressor&)>;

/// Every law of the library that `testable` allows, joint by joint, with its non-linear numbers on
/// a grid. Returns nothing twice; columns live only while they are visited.
void visit_library(const WhitenedFit& whitened, const std::vector<std::string>& not_testable,
                   const RegressorVisitor& visit);

/// One regressor of the library again, with other constants.
Regressor library_regressor(const WhitenedFit& whitened, const EffectEntry& entry);

/// Waves of one joint at these cycles a turn, together.
Regressor ripple_regressor(const WhitenedFit& whitened, int joint,
                           const std::vector<double>& cycles);

/// What a scan of waves tries: k of every joint, in steps its range can tell apart. Usual: up to 40
/// cycles a turn; fast: from there to 200, and those of the motor where the gear ratio is given.
std::vector<double> ripple_grid(const WhitenedFit& whitened, int joint);
std::vector<double> fast_ripple_grid(const WhitenedFit& whitened, int joint);

/// Largest load of a joint at the poses [N m].
double largest_torque(const WhitenedFit& whitened, int joint);

/// Generic structure, so that what no law explains is not forced into one.
void visit_patterns(const WhitenedFit& whitened, const RegressorVisitor& visit);

}  // namespace plumb::offline

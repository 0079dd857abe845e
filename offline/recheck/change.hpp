// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "solve/solution.hpp"

namespace plumb::offline::recheck {

/// The part of arm or measurement in which something may have changed since the calibration.
enum class Part { kTool, kBase, kJoint, kReading, kOther };

/// "tool", "base", "joint", "reading", "other".
const char* name_of(Part part);

/// Something that may have changed, as numbers of the model that would differ now.
struct Change {
  Part part = Part::kOther;
  int joint = -1;           // of kJoint
  std::string effect = {};  // "target", "frame"; of a joint "offset", "link" (bent) or the name of
                            // an effect; empty: a reading, or something else
  int row = -1;             // of kReading: a reading that contradicts all others
  std::vector<Parameter> parameters = {};  // none: of kReading and kOther
  Eigen::VectorXd typical = {};            // 1 sigma of how far each of them changes, SI
  std::vector<double> scales = {};         // by which `typical` is multiplied in turn
  double chance = 0.0;                     // that it is this one, before anything is measured
};

/// Whether two are of the same part, joint and effect.
bool same(const Change& a, const Change& b);

/// "the tool or the reflector", "the base or the tracker", "J3: encoder offset".
std::string words_of(const Change& change, const Cell& cell);

/// A model with every effect that a change could need (EffectDescriptor::later_change): where the
/// run has none of a joint, one of size zero.
///
/// @param state   Of the run, first set-up only.
/// @param of_arm  The cell's own measurements, from which constants of effects are taken.
/// @param rows    The new readings: backlash needs the direction from which each joint came.
ArmState with_room_for_changes(const Cell& cell, const Measurements& of_arm,
                               const Measurements& rows, const ArmState& state);

/// Every change that is looked for: each moves the measured point somewhere, as the stiffness of a
/// joint does only where masses are known. The chances add up to 1 with those of single readings.
///
/// @param extended  As `with_room_for_changes` returns it.
/// @param poses     Over which the arm works.
/// @param readings  How many different poses are judged.
std::vector<Change> possible_changes(const Cell& cell, const ArmState& extended,
                                     const Measurements& poses, int readings);

/// Residuals of all rows, measured - predicted [m], and derivatives of the predicted points; no
/// priors, and every coordinate counts alike.
Solution linearised(const Measurements& rows, const ArmState& state,
                    const std::vector<Parameter>& parameters);

/// Derivatives of the predicted points, shape (lines, parameters) [m/SI]; lines stand pose by pose.
Eigen::MatrixXd derivatives(const Measurements& rows, const ArmState& state,
                            const std::vector<Parameter>& parameters);

/// A reading that contradicts all others, for instance because the beam was touched.
Change odd_reading(int row, int readings, double sigma_m);

}  // namespace plumb::offline::recheck

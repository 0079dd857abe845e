// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/judged_fit.hpp"

namespace plumb::offline {

/// The cell with gravity in another direction, fitted and judged.
struct UnderOtherGravity {
  OtherGravity gravity;
  std::unique_ptr<const Cell> cell;  // what `judged` refers to
  Calibration calibration;
  JudgedFit judged;
};

/// Whether the loads explain these poses better if gravity acts in another direction than the cell
/// states: the arm hangs on a wall or from a ceiling, or stands tilted.
///
/// The motion by a load is linear in gravity. So every law of a load without further constants is
/// fitted with gravity along x, y and z of the base, each with a size of its own; what the three
/// have in common is the direction. The whole scan is then made under it. The direction is certain
/// if the best law of a load leads by kAhead_nats over all that explains these poses under the
/// stated direction, the two angles being paid for, and explains clearly more or leaves nothing but
/// noise. It is one of two explanations if it leads by kSupported.
///
/// The direction is looked for before the scatter of the joints is estimated: what the loads do to
/// an arm under a wrong direction looks like scatter, and whitened by it nothing would be left to
/// find.
///
/// None where what was found under the stated direction reaches the noise, where no mass is known,
/// and where the noise is not known.
///
/// @param plain   The fit under the stated direction, without scatter.
/// @param stated  The same, judged.
/// Cost: 40 regressors on some of the poses; a calibration and a scan more where they speak for it.
std::optional<UnderOtherGravity> under_other_gravity(
    const Cell& cell, const Measurements& measured, const Calibration& calibration,
    const std::vector<int>& rows, const std::vector<int>& held, const WhitenedFit& plain,
    const JudgedFit& stated, const std::vector<std::string>& not_testable);

/// "the arm seems to hang on a wall": how an arm stands on which gravity acts along that direction
/// of its base frame.
std::string standing_words(const std::array<double, 3>& gravity);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/measurements.hpp"
#include "check/measurement_edit.hpp"
#include "fit/measured_orientations.hpp"

namespace plumb::offline {

/// Another way to read the orientation columns, in words and as an edit of the files.
struct NamedInterpretation {
  OrientationInterpretation interpretation;
  std::string words;
  MeasurementEdit edit;
};

/// All ways but the labelled one, for these rows: quaternions in another order, three angles in
/// another order or unit, a rotation vector, and each of them as the inverse rotation. None if the
/// files differ in what they hold.
std::vector<NamedInterpretation> orientation_interpretations(const MeasurementFiles& measured,
                                                             const std::vector<int>& rows);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::tests {

/// What a diagnosis may see: the two files, read back.
struct Seen {
  offline::Cell cell;
  offline::MeasurementFiles measured;
};

Seen written_and_read(const offline::BlindCase& blind, std::uint64_t seed);

/// Per-axis RMS from the noise-free truth on fresh poses [m]. Effects of the measurement act on
/// fresh poses too unless they happened once.
double true_error(offline::ArmState arm, const offline::Simulation& fresh);

/// Fitted to all readings.
offline::ArmState fitted(const Seen& seen, const std::vector<offline::EffectEntry>& effects);

}  // namespace plumb::tests

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "cell/cell.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/held_out.hpp"

namespace plumb::offline {

/// How many of the steps are kept. They were selected by the fitted readings; the held-out readings
/// can only refuse them: where the held-out error leaps, or ends clearly above its minimum, the
/// steps after the minimum are dropped.
///
/// @param before, errors  At the start, and after each step, in one unit.
std::size_t steps_kept(double before, const std::vector<double>& errors);

/// Of the effects that a diagnosis has added so far. Points and orientations count as one error,
/// the latter in their noise floors.
std::size_t steps_kept(const Diagnosis& found);

/// Whether this held-out error is above the one at the start: its mean, or by single large errors
/// its RMS. Counted as above.
bool rises_over(const Diagnosis& found, const HeldOutError& after);

/// The held-out error of the start, or after so many of the added effects.
HeldOutError error_after(const Diagnosis& found, std::size_t steps);

/// Says which of the added effects are not kept, and how the error rose.
Problem refusal(const Cell& cell, const Diagnosis& found, std::size_t kept,
                const HeldOutError& rose_to);

}  // namespace plumb::offline

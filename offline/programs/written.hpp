// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "programs/program.hpp"

namespace plumb::offline::programs {

/// The pose that numbers in this notation mean [m]; nothing if they are no pose: too few, or a
/// quaternion whose length is not 1 within 1 %.
std::optional<Transformd> pose_of(Notation notation, std::span<const double> numbers);
std::optional<Transformd> pose_of(const Written& written);

/// The values of the numbers, in their order.
std::vector<double> values_of(const Written& written);

/// The numbers of pose X in this notation. Of the many ways to write an orientation that nearest to
/// `like`, which has the numbers of a pose nearby.
std::vector<double> numbers_like(const Transformd& X, Notation notation,
                                 std::span<const double> like);

/// Digits after the point of a number as it stands in a file; of "1.5E-3" 4.
int decimals_of(std::string_view text);

/// The number with so many decimals, written as its neighbour `like` is: without a zero before the
/// point if that has none, never as "-0".
std::string written_like(double value, int decimals, std::string_view like);

}  // namespace plumb::offline::programs

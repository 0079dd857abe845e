// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "check/convention.hpp"
#include "check/joint_maps.hpp"

namespace plumb::offline {

/// The convention of a joint map, its factors and zeros rounded to what a person would write: a
/// unit or a whole number, and a round number of degrees.
Convention convention_of(const JointMap& map, const Convention& labels);

/// Whether it changes more than `fit` can find by itself, such as a large joint zero or a factor.
bool is_beyond_fit(const Convention& convention);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::format {

/// A six-axis arm with trees, effects and covariance; a planar arm with a sliding joint and next to
/// nothing; a planar arm with two revolute joints and one linear leaf.
Model six_axis_model();
Model planar_model();
Model planar_2r_model();

/// The latter with blended, quadratic, oblique trees that know their region and their error.
Model blended_model();

/// And with a law of the user's own.
Model formula_model();

/// The same, with ranges of what it was told in the poses of its fit.
Model ranges_model();

/// File name without ending, and content.
std::vector<std::pair<std::string, Model>> golden_models();

}  // namespace plumb::format

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/format/model.hpp"

/// Limits of a model file, checked with the same messages when an effect is added and when the
/// model is compiled. Both throw Failure (kNumbersSayNo, E-MODEL-UNSOUND).
namespace plumb::offline::cli {

/// An effect of more parameters than a model holds: kMaxParameters, all of which have a covariance,
/// or of a series of waves, whose numbers have none, kMaxEffectParameters. Before the fit, which
/// would be long.
void check_effect_sizes(const std::vector<format::Effect>& bound);

/// More than kMaxParameters fitted parameters. Which of them these poses tell is known only after
/// the fit.
void check_parameter_count(const format::Model& compiled);

}  // namespace plumb::offline::cli

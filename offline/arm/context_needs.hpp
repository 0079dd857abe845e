// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/contexts.hpp"
#include "plumb/format/model.hpp"

/// What the effects of a model must know of a pose besides its joint positions.
namespace plumb::offline {

/// One input of one effect.
struct ContextWant {
  enum class Kind { kDirection, kMove, kPlaceInSeries, kMoment, kWarmth, kLoad };
  Kind kind = Kind::kDirection;
  std::string effect;     // "reversal", or the name of the formula
  std::string column;     // of a measurement file: "dir_j2", "temp_arm_degC"
  std::size_t index = 0;  // the joint, or the place among temperature_names(model)
  double fallback = 0.0;  // replaces an unknown value; SI, temperatures in [degC]
};

/// In the order of the effects. The load is listed only if the poses of the fit carried several.
std::vector<ContextWant> context_wants(const format::Model& model);

/// Ranges of what the effects of `model` were told in these rows: load, wrench, temperatures. A row
/// that does not say its payload carries the model's own.
std::vector<format::ContextRange> trained_context(const format::Model& model,
                                                  const ContextRows& rows);

/// Those of `ranges` that an effect of the model reads.
std::vector<format::ContextRange> ranges_read(const format::Model& model,
                                              const std::vector<format::ContextRange>& ranges);

}  // namespace plumb::offline

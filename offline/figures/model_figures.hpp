// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "figures/run_results.hpp"

/// Figures of the model that a run compiles to. Each returns one SVG file, `width` px wide (320 to
/// 4000), whatever the data.
namespace plumb::offline::figures {

/// Predicted 1 sigma of the corrected point, the measured axes together, at poses spread over the
/// joint limits, by the covariance of the run. Cost: poses * numbers^2.
std::string uncertainty_figure(const RunResults& results, double width);

/// What the trees correct, and where their leaves end, over their two most used inputs; the other
/// joints stand in the middle of the trained range.
std::string leaf_map_figure(const RunResults& results, double width);

/// At which poses within the joint limits the runtime's inverse refuses, the guard would cut the
/// correction, or the model was not trained; over the workspace and by joint.
/// Cost: 2000 inverse corrections of the compiled model.
std::string refusals_figure(const RunResults& results, double width);

/// What is left over temperature, payload or time, one panel for each axis of the tracker and each
/// sensor.
enum class Quantity { kTemperature, kPayload, kTime };
std::string context_figure(const RunResults& results, Quantity quantity, double width);

/// Whether the measurements know that quantity and it was not the same at all poses.
bool context_varies(const RunResults& results, Quantity quantity);

}  // namespace plumb::offline::figures

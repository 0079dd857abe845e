// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/format/model.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// Everything a model file says, in mm and deg; trees and covariance as sizes.
Json model_json(const format::Model& model);

/// The same for people.
std::string model_text(const format::Model& model);

/// What the guard lets through: "position only, at most 3.000 mm, changing by ...".
std::string corrected_text(const format::GuardLimits& guard);

/// Loads and temperatures of the fit poses: "payload 0 .. 60 kg, temp 18 .. 24 degC"; empty: none.
std::string context_text(const format::Model& model);

}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format::internal {

/// Describes the first fault of a model in one sentence with place and value; empty if it is sound.
/// A sound model is finite, within the limits of limits.hpp, and its trees can be walked.
std::optional<std::string> unsoundness(const Model& model);

}  // namespace plumb::format::internal

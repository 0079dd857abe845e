// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::format {

/// Returns the bytes of a model file. The same model gives the same bytes.
/// Throws std::invalid_argument with the sentence of the semantic check if the model is invalid.
std::vector<std::byte> write_model(const Model& model);

}  // namespace plumb::format

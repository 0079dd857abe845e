// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format::internal {

/// What contradicts itself in where a model comes from: hashes, held-out figures, covariance.
/// Nothing if it is sound.
std::optional<std::string> unsound_provenance(const Provenance& provenance);

}  // namespace plumb::format::internal

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format::internal {

/// Describes a contradiction in the provenance of a model: in hashes, held-out figures or
/// covariance. Empty if there is none.
std::optional<std::string> unsound_provenance(const Provenance& provenance);

}  // namespace plumb::format::internal

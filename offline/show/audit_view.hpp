// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "compile/audit.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `audit` of `compile` and `inspect`.
Json audit_json(const Audit& audit, const format::Model& model);

/// The same as a table.
std::string audit_text(const Audit& audit, const format::Model& model);

/// "0.071 mm at a point 100 mm away, because positions do not show how the last link is turned".
std::string beside_words(const ToolUncertainty& tool);

}  // namespace plumb::offline::show

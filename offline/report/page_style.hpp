// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline::report {

/// The style sheet of the report: that of the figures, and the page around them in the same
/// colours. On paper A4, light, no figure or row of a table cut.
std::string page_style();

}  // namespace plumb::offline::report

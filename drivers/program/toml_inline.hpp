// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// TOML 1.1 lets inline tables { … } run over several lines, hold comments and end with a comma;
/// the parser reads TOML 1.0. Line breaks, comments and last commas inside them become spaces, one
/// for each character, so that positions can be traced back. Valid TOML 1.0 comes back unchanged.
std::string join_inline_tables(std::string_view text);

}  // namespace plumb

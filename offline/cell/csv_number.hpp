// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace plumb::offline {

/// Why a cell is no number.
enum class NumberFault { kNone, kEmpty, kNotANumber, kNotFinite, kOutOfRange };

/// Reads a decimal number with a point, a leading '+' allowed; with ';' between columns a comma is
/// a decimal sign too. Never allocates for up to 64 characters.
NumberFault read_number(std::string_view text, char separator, double& value);

}  // namespace plumb::offline

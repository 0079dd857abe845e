// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "program/outcome.hpp"

namespace plumb::offline::cli {

/// "plumb -C cell compile": the words behind `plumb` as they must be typed to work in the same
/// cell.
std::string to_type(const Globals& globals, const std::string& words);

/// The last lines of a verb's text: the command that helps most, and others that would do.
///
/// @param words  What follows `plumb`; behind " # " may stand why.
void say_next(const Globals& globals, const std::string& words, Outcome& outcome);
void say_next(const Globals& globals, const std::vector<std::string>& words, Outcome& outcome);

}  // namespace plumb::offline::cli

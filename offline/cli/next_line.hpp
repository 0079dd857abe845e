// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "program/outcome.hpp"

namespace plumb::offline::cli {

/// The whole command for the words that follow `plumb`, such as "plumb -C cell compile": with the
/// -C of this call, also in further commands behind "&&", so that it works when it is pasted.
std::string to_type(const Globals& globals, const std::string& words);

/// The last lines of a verb's text, and of its blocks: the command that helps most, and others that
/// would do.
///
/// @param words  The words that follow `plumb`; the reason may follow them behind " # ".
void say_next(const Globals& globals, const std::string& words, Outcome& outcome);
void say_next(const Globals& globals, const std::vector<std::string>& words, Outcome& outcome);

}  // namespace plumb::offline::cli

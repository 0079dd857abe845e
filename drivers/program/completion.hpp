// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/command_table.hpp"

namespace plumb {

/// A script that the shell sources, to complete verbs, options and the words that options take.
/// Where a value is none of a few words, the shell completes file names.
std::string bash_completion(const CommandTable& table);
std::string zsh_completion(const CommandTable& table);
std::string fish_completion(const CommandTable& table);

/// "plumb-rt" as a part of the name of a shell function: "plumb_rt".
std::string function_name(const std::string& program);

}  // namespace plumb

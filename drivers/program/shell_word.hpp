// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb {

/// The word as it is typed in a shell: quoted if it has to be.
std::string shell_word(const std::string& text);

/// What a command begins with that works in the same cell: "plumb -C cell ", or "plumb " if no
/// folder was named.
std::string command_in(const std::string& program, const std::string& directory);

}  // namespace plumb

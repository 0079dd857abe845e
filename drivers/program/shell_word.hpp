// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb {

/// As a shell takes it: quoted where it must be.
std::string shell_word(const std::string& text);

}  // namespace plumb

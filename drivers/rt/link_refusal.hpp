// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/problem.hpp"

namespace plumb::drivers::rt {

/// A bus that cannot be opened, and why.
[[noreturn]] inline void refuse_link(std::string what, std::string help) {
  throw Failure(Exit::kEnvironment,
                {.code = "E-RT-LINK", .message = std::move(what), .help = std::move(help)});
}

}  // namespace plumb::drivers::rt

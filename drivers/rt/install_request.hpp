// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "rt/version_change.hpp"

namespace plumb::drivers::rt {

/// What is to be installed, and where.
struct InstallRequest {
  ChangeRequest change;
  std::filesystem::path from;  // the deploy folder
  int keep = 5;                // versions that stay at least
  enum class Older : std::uint8_t { kRefused, kAllowed } older = Older::kRefused;
};

}  // namespace plumb::drivers::rt

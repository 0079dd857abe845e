// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "rt/listener.hpp"

namespace plumb::drivers::rt {

/// Where the socket of the plumb-rt that runs DIR may be, best first: in /run/plumb, which the
/// systemd unit makes, in $XDG_RUNTIME_DIR, in DIR itself. Named after the folder, so that two of
/// them do not meet.
std::vector<std::filesystem::path> control_paths(const std::filesystem::path& dir);

/// A socket that is removed at the end.
struct ControlSocket {
  std::filesystem::path path;
  Descriptor listening;
};

/// Throws Failure (kEnvironment): E-RT-RUNNING if another plumb-rt runs this folder, E-RT-CONTROL
/// if there is nowhere to listen.
ControlSocket open_control(const std::filesystem::path& dir);

/// Asks the plumb-rt that runs this folder. Throws Failure (kEnvironment, E-RT-NOT-RUNNING).
std::string ask_control(const std::filesystem::path& dir, const std::string& request,
                        int within_ms);

}  // namespace plumb::drivers::rt

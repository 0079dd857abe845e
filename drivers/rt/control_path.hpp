// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/listener.hpp"

namespace plumb::drivers::rt {

/// A name for what belongs to the runs of DIR: "plumb-rt-" and 12 hexadecimal digits of its path.
std::string name_of_run(const std::filesystem::path& dir);

/// The possible paths of the control socket of the plumb-rt that runs DIR, best first: in
/// /run/plumb, which the systemd unit creates, in $XDG_RUNTIME_DIR, and in DIR itself. The name
/// depends on the folder, so that several plumb-rt do not collide.
std::vector<std::filesystem::path> control_paths(const std::filesystem::path& dir);

/// A listening socket, whose file is removed at the end of the run.
struct ControlSocket {
  std::filesystem::path path;
  Descriptor listening;
};

/// Opens the control socket. Throws Failure (kEnvironment): E-RT-RUNNING if another plumb-rt runs
/// this folder, E-RT-CONTROL if there is nowhere to listen.
ControlSocket open_control(const std::filesystem::path& dir);

/// Sends a request to the plumb-rt that runs this folder and returns its answer. Throws Failure
/// (kEnvironment, E-RT-NOT-RUNNING).
std::string ask_control(const std::filesystem::path& dir, const std::string& request,
                        int within_ms);

}  // namespace plumb::drivers::rt

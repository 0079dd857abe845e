// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/outcome.hpp"
#include "rt/install_request.hpp"

namespace plumb::drivers::rt {

/// Copies a deploy folder into the place, verifies the copy as `run` would, and makes it current.
/// A plumb-rt that runs the place swaps to its model first, if nothing but [model] of rt.toml
/// differs; if it refuses, nothing has changed. The steps are ordered so that a program that is
/// killed anywhere leaves the old version current, or the new one, whole; what else it leaves is
/// removed by the next one. Warnings go to `outcome`. Slow. Throws Failure:
///   E-RT-INSTALLING  another install or rollback works in the place (kEnvironment)
///   E-RT-OLDER       the folder was made before the newest that was ever installed there
///   E-RT-RESTART     what runs would have to be started again, and kRestart was not given
///   E-RT-PLACE, E-RT-FOLDER, E-WRITE, those of load_deployment, and what the running one answers
Changed install(const InstallRequest& request, Outcome& outcome);

/// Makes another version current that the place still has: `version`, or if that is empty the one
/// before the current one. It is verified first. Throws as `install` does, and E-RT-ROLLBACK if
/// there is no such version.
Changed roll_back(const ChangeRequest& request, const std::string& version, Outcome& outcome);

}  // namespace plumb::drivers::rt

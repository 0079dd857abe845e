// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/outcome.hpp"
#include "rt/install_history.hpp"
#include "rt/place.hpp"

namespace plumb::drivers::rt {

/// How the version of a place that is current is changed.
struct ChangeRequest {
  Place place;
  std::string etc;        // folder of the machine's settings
  double change_m = 0.0;  // the change of corrections that the operator allows; 0: that of rt.toml
  enum class Running : std::uint8_t {
    kSwap,    // a plumb-rt that runs goes on with the new model at once, or nothing changes
    kRestart  // it runs on as it is until it is started again
  } running = Running::kSwap;
};

struct InstallRequest {
  ChangeRequest change;
  std::filesystem::path from;  // the deploy folder
  int keep = 5;                // versions that stay at least
  enum class Older : std::uint8_t { kRefused, kAllowed } older = Older::kRefused;
};

/// What an install or a rollback has done.
struct Changed {
  HistoryLine line;
  bool nothing = false;              // the version was current, and runs if anything does
  double change_mm = 0.0;            // by which the swap changes corrections; 0 without one
  std::vector<std::string> removed;  // versions that were too old to keep
};

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

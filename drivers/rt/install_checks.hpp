// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/outcome.hpp"
#include "rt/deployment.hpp"
#include "rt/install_request.hpp"

namespace plumb::drivers::rt {

/// An older folder is installed only on purpose. Throws Failure (kInput, E-RT-OLDER) if `made`, the
/// time at which the folder was made, is before the newest that was ever installed in the place;
/// the message names a clock that looks wrong. `id`: its version.
void refuse_older(const InstallRequest& request, const std::string& made, const std::string& id,
                  const PlaceBefore& before);

/// A place belongs to one robot: the wrong folder in the wrong place is refused, also while nothing
/// runs. Throws Failure (kInput, E-RT-SERIAL).
void refuse_other_robot(const InstallRequest& request, const Deployment& next,
                        const PlaceBefore& before);

/// W-RT-CLOCK if the folder was made in the future of this machine's clock.
void warn_of_clock(const InstallRequest& request, const std::string& made, Outcome& outcome);

}  // namespace plumb::drivers::rt

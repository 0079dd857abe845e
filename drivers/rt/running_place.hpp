// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "rt/place.hpp"
#include "rt/swap_request.hpp"

namespace plumb::drivers::rt {

/// The plumb-rt that runs a place, as another program sees it.
struct RunningPlace {
  std::string version;  // whose model it runs; empty: another model was swapped in
  std::string packing;  // of the controller's registers, and its remedy; empty: as laid out
};

/// Nothing if none runs the place. Throws Failure (kEnvironment, E-RT-CONTROL) if one does, which
/// does not answer to this user.
std::optional<RunningPlace> find_running(const InstallPlace& place);

/// Asks it to swap, and returns by how much corrections change [mm]. Throws Failure (kInput) with
/// its own words if it refuses, kEnvironment if it does not answer.
double ask_swap(const InstallPlace& place, const SwapRequest& request);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rt/ceilings.hpp"
#include "rt/model_change.hpp"

namespace plumb::drivers::rt {

/// What `plumb-rt swap` asks of the running plumb-rt.
struct SwapRequest {
  std::string file;       // absolute
  double change_m = 0.0;  // the change of corrections that the operator allows to this swap;
                          // 0: that of rt.toml
};

/// The line "swap FILE" or "swap within_um=1500 FILE".
std::string swap_line(const SwapRequest& request);

/// The request in the words behind "swap ".
SwapRequest read_swap(const std::string& words);

/// Why this change is too large for the request and the ceilings; empty if it is not. An allowance
/// of the operator widens the limit of rotations by the same factor.
std::string change_fault(const ModelChange& change, const SwapRequest& request,
                         const Ceilings& ceilings);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit/solver.hpp"

namespace plumb::offline {

/// Where tracker and reflector stand: fits frame and target (those of `candidates` that belong to
/// the measurement) with the arm of `nominal`. The frame may be metres and half-turns away.
Solution place(const FitData& data, const ArmState& nominal,
               const std::vector<Parameter>& candidates);

}  // namespace plumb::offline

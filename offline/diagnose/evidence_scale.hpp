// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/evidence.hpp"
#include "diagnose/whitened_fit.hpp"

namespace plumb::offline {

/// What the evidence at a whitened fit is measured with.
EvidenceScale evidence_scale(const WhitenedFit& whitened);

}  // namespace plumb::offline

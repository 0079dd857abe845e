// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/revision.hpp"

namespace plumb::offline {

/// Poses that the others contradict are left out. If the first poses of a series were, or the last
/// ones, something may have moved once between them and the rest. They are therefore put back once,
/// and a step is added if it explains them.
extern const Revision kLeftOutEnds;

}  // namespace plumb::offline

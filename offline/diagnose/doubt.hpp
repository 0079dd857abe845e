// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/revision.hpp"

namespace plumb::offline {

/// A clear remainder, too small to count as an effect beside the strongest added one, may show that
/// this one stands for several other effects. It is replaced by such effects if they leave only
/// noise.
extern const Revision kDoubt;

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/revision.hpp"

namespace plumb::offline {

/// The first effects were chosen while the others were still missing. Each effect is therefore
/// taken out once and searched for again, and replaced by a better one.
/// A step is taken out again whenever the yielding of the arm has come into the model since: what
/// gravity does may have passed for the slip of an encoder, or hidden that of the tool.
extern const Revision kExchange;

/// An effect of a size that hardly any arm has is taken out once, and replaced by another one of a
/// usual size that these poses cannot tell from it.
extern const Revision kExchangeForSize;

}  // namespace plumb::offline

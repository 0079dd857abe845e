// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// A clear remainder, too small to count as an effect beside the strongest added one, may show that
/// this one stands for several other effects. Tries to replace it by such effects; true if they
/// leave only noise and have replaced it.
bool doubt_strongest(Selection& selection);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/random.hpp"

namespace plumb::offline::study {

/// N(0, 1) by Box and Muller.
double normal(Random& random);

}  // namespace plumb::offline::study

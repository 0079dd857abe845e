// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/random.hpp"

namespace plumb::offline::study {

/// A normally distributed random number N(0, 1), by the method of Box and Muller.
double normal(Random& random);

}  // namespace plumb::offline::study

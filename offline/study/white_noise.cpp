// SPDX-License-Identifier: Apache-2.0
#include "study/white_noise.hpp"

#include <cmath>
#include <numbers>

namespace plumb::offline::study {

double normal(Random& random) {
  const double size = std::sqrt(-2.0 * std::log(1.0 - random.unit()));
  return size * std::cos(2.0 * std::numbers::pi * random.unit());
}

}  // namespace plumb::offline::study

// SPDX-License-Identifier: Apache-2.0
#include "draw/duration.hpp"

#include <fmt/format.h>

namespace plumb::offline::draw {

std::string duration(double ns) {
  if (ns < 999.5) return fmt::format("{:.0f} ns", ns);
  if (ns < 999.5e3) return fmt::format("{:.3g} us", 1e-3 * ns);
  if (ns < 999.5e6) return fmt::format("{:.3g} ms", 1e-6 * ns);
  return fmt::format("{:.3g} s", 1e-9 * ns);
}

}  // namespace plumb::offline::draw

// SPDX-License-Identifier: Apache-2.0
#include "import/euler.hpp"

#include "program/problem.hpp"

namespace plumb::offline {

EulerConvention euler_convention(std::string_view name) {
  if (const auto found = find_euler_convention(name)) return *found;
  throw Failure(Exit::kUsage,
                {.code = "E-IMPORT-ROT",
                 .message = "--rot: '" + std::string(name) + "' is no order of turns",
                 .help = "xyz-fixed (R = Rz Ry Rx), xyz-moving (R = Rx Ry Rz), zyz-moving, ..., or "
                         "rotation-vector"});
}

}  // namespace plumb::offline

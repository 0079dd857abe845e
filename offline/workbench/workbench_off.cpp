// SPDX-License-Identifier: Apache-2.0
#include "program/problem.hpp"
#include "workbench/workbench.hpp"

/// In the place of workbench.cpp where the program is built without it (PLUMB_WORKBENCH=OFF).
namespace plumb::offline::workbench {

void serve(const ServeSettings&, const std::function<void(const std::string& url)>&) {
  throw Failure(Exit::kEnvironment,
                {.code = "E-SERVE-OFF",
                 .message = "this plumb was built without the workbench",
                 .help = "scripts/install-deps, then cmake --preset release -DPLUMB_WORKBENCH=ON "
                         "and build"});
}

}  // namespace plumb::offline::workbench

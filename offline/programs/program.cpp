// SPDX-License-Identifier: Apache-2.0
#include "programs/program.hpp"

#include <utility>

namespace plumb::offline::programs {

int Program::list(std::string name, std::size_t source, int line, std::string why,
                  std::string help) {
  targets.push_back({.name = std::move(name),
                     .source = source,
                     .line = line,
                     .why = std::move(why),
                     .help = std::move(help)});
  return static_cast<int>(targets.size()) - 1;
}

}  // namespace plumb::offline::programs

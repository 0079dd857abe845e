// SPDX-License-Identifier: Apache-2.0
#include "programs/settle.hpp"

#include <fmt/format.h>

#include <utility>

namespace plumb::offline::programs {
namespace {

void take(std::string& own, const std::string& of_move, bool first, const char* what, int line,
          Target& target) {
  if (first && own.empty()) own = of_move;
  if (own == of_move || of_move.empty()) return;
  target.leave(
      fmt::format("two {}s are used with it: '{}', and '{}' in line {}", what, own, of_move, line),
      fmt::format("give each {} a target of its own", what));
}

}  // namespace

void settle(Program& program) {
  std::vector<int> uses(program.targets.size(), 0);
  std::vector<bool> configured(program.targets.size(), false);
  for (const Move& move : program.moves) {
    if (move.target < 0) continue;
    const auto t = static_cast<std::size_t>(move.target);
    const bool first = uses[t]++ == 0;
    configured[t] = configured[t] || move.configured;
    if (of_joints(program.targets[t].written.notation)) continue;  // reached with any tool
    take(program.targets[t].tool, move.tool, first, "tool", move.line, program.targets[t]);
    take(program.targets[t].frame, move.frame, first, "frame", move.line, program.targets[t]);
  }
  for (std::size_t t = 0; t < uses.size(); ++t) {
    Target& target = program.targets[t];
    if (!configured[t]) target.configuration = {};
    if (uses[t] == 0)
      target.leave("no move of the program goes to it",
                   "nothing, if it is not used; else use it in a move of this program");
  }
}

}  // namespace plumb::offline::programs

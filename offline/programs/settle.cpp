// SPDX-License-Identifier: Apache-2.0
#include "programs/settle.hpp"

#include <fmt/format.h>

#include <utility>

#include "programs/lexer.hpp"

namespace plumb::offline::programs {
namespace {

void take(std::string& own, const std::string& of_move, bool first, const char* what, int line,
          Target& target) {
  if (first && own.empty()) own = of_move;
  if (own == of_move || of_move.empty() || !target.why.empty()) return;
  target.why =
      fmt::format("two {}s are used with it: '{}', and '{}' in line {}", what, own, of_move, line);
  target.help = fmt::format("give each {} a target of its own", what);
}

}  // namespace

void settle_between(Program& program, const Program& other) {
  std::map<std::string, int> missing;
  for (const Target& target : other.targets)
    if (target.missing) missing.emplace(lower_case(target.name), target.line);
  for (Target& target : program.targets) {
    const auto at = missing.find(lower_case(target.name));
    if (at == missing.end() || !target.why.empty()) continue;
    target.why = fmt::format("{}:{} moves to it too", other.sources[0].file, at->second);
    target.help = "state it in the file of its moves, each with a target of its own";
  }
}

void settle(Program& program) {
  std::vector<int> uses(program.targets.size(), 0);
  for (const Move& move : program.moves) {
    if (move.target < 0) continue;
    const auto t = static_cast<std::size_t>(move.target);
    const bool first = uses[t]++ == 0;
    take(program.targets[t].tool, move.tool, first, "tool", move.line, program.targets[t]);
    take(program.targets[t].frame, move.frame, first, "frame", move.line, program.targets[t]);
  }
  for (std::size_t t = 0; t < uses.size(); ++t) {
    Target& target = program.targets[t];
    if (uses[t] > 0 || !target.why.empty()) continue;
    target.why = "no move of the program goes to it";
    target.help = "nothing, if it is not used; else use it in a move of this program";
  }
}

}  // namespace plumb::offline::programs

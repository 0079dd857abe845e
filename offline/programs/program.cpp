// SPDX-License-Identifier: Apache-2.0
#include "programs/program.hpp"

#include <utility>

namespace plumb::offline::programs {

void Facts::add(const Facts& other) {
  constexpr std::size_t kEnough = 2;  // one of them is in another file than that which asks
  for (const auto& [name, places] : other.mentions) {
    auto& own = mentions[name];
    for (const Place& place : places)
      if (own.size() < kEnough) own.push_back(place);
  }
  for (const auto& [routine, called] : other.calls)
    calls[routine].insert(called.begin(), called.end());
  sets_tool.insert(other.sets_tool.begin(), other.sets_tool.end());
  sets_frame.insert(other.sets_frame.begin(), other.sets_frame.end());
  moves.insert(other.moves.begin(), other.moves.end());
  assigned.insert(other.assigned.begin(), other.assigned.end());
  joint_configurations = joint_configurations && other.joint_configurations;
  linear_configurations = linear_configurations && other.linear_configurations;
  if (displaced.empty()) displaced = other.displaced;
}

void Facts::close() {
  for (std::set<std::string>* setters : {&sets_tool, &sets_frame, &moves})
    for (std::size_t before = setters->size() + 1; before != setters->size();) {
      before = setters->size();
      for (const auto& [routine, called] : calls)
        for (const std::string& name : called)
          if (setters->contains(name)) setters->insert(routine);
    }
}

void Target::leave(std::string reason, std::string remedy) {
  if (!why.empty()) return;
  why = std::move(reason);
  help = std::move(remedy);
}

int Program::add_inline(Target target, std::size_t source, int line) {
  target.name = "target of the move";
  target.source = source;
  target.line = line;
  targets.push_back(std::move(target));
  return static_cast<int>(targets.size()) - 1;
}

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

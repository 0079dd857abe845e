// SPDX-License-Identifier: Apache-2.0
#include "programs/names.hpp"

#include <fmt/format.h>

#include <utility>

namespace plumb::offline::programs {
namespace {

void spoil(Target& target, std::string why, std::string help) {
  if (!target.why.empty()) return;
  target.why = std::move(why);
  target.help = std::move(help);
}

}  // namespace

void Names::declare(const Tokens& tokens, std::size_t name, Target target) {
  allow(tokens, name);
  target.name = std::string(tokens.text(name));
  target.source = tokens.source();
  target.line = tokens.line(name);
  program_->targets.push_back(std::move(target));
  const int own = static_cast<int>(program_->targets.size()) - 1;
  const auto [other, is_new] = index_.emplace(tokens.lower(name), own);
  if (is_new) return;
  for (const int t : {other->second, own})
    spoil(program_->targets[static_cast<std::size_t>(t)],
          fmt::format("its name is declared more than once, in line {} too", tokens.line(name)),
          "give every target a name of its own");
}

int Names::used(const Tokens& tokens, std::size_t name) {
  const auto found = index_.find(tokens.lower(name));
  if (found == index_.end()) return -1;
  allow(tokens, name);
  return found->second;
}

void Names::look_for_mentions(const Tokens& tokens) {
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens.is_word(i)) continue;
    const auto found = index_.find(tokens.lower(i));
    if (found == index_.end() || allowed_.contains(place(tokens, i))) continue;
    spoil(program_->targets[static_cast<std::size_t>(found->second)],
          fmt::format("line {} uses it for something else than a move to it", tokens.line(i)),
          "give the moves a target that nothing else reads or changes");
  }
}

void Names::spoil_all(const std::string& why, const std::string& help) {
  for (Target& target : program_->targets) spoil(target, why, help);
}

}  // namespace plumb::offline::programs

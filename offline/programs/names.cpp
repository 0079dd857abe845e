// SPDX-License-Identifier: Apache-2.0
#include "programs/names.hpp"

#include <fmt/format.h>

#include <utility>

namespace plumb::offline::programs {
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
    program_->targets[static_cast<std::size_t>(t)].leave(
        fmt::format("its name is declared more than once, in line {} too", tokens.line(name)),
        "give every target a name of its own");
}

int Names::used(const Tokens& tokens, std::size_t name) {
  const auto found = index_.find(tokens.lower(name));
  if (found == index_.end()) return -1;
  allow(tokens, name);
  return found->second;
}

void Names::declare(const Tokens& tokens, std::size_t name, Frames& frames, Frame frame) {
  allow(tokens, name);
  frames_[tokens.lower(name)] = &frames;
  const auto [at, is_new] = frames.emplace(tokens.lower(name), std::move(frame));
  if (!is_new) at->second = {.X = {}, .why = "it is declared more than once", .moving = true};
}

void Names::spoil(const std::string& name, const std::string& where) {
  const std::string why = where + " uses it for something else than a move";
  if (const auto target = index_.find(name); target != index_.end())
    program_->targets[static_cast<std::size_t>(target->second)].leave(
        why + " to it", "give the moves a target that nothing else reads or changes");
  if (const auto frame = frames_.find(name); frame != frames_.end())
    (*frame->second)[name] = {.X = {}, .why = why, .moving = true};
}

void Names::mention(const Tokens& tokens, std::size_t i, const std::string& lower_name) {
  auto& places = program_->facts.mentions[lower_name];
  if (places.empty()) places.push_back({program_->sources[0].file, tokens.line(i)});
  spoil(lower_name, fmt::format("line {}", tokens.line(i)));
}

void Names::look_for_mentions(const Tokens& tokens) {
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens.is_word(i) && !allowed_.contains(place(tokens, i)))
      mention(tokens, i, tokens.lower(i));
}

void Names::look_elsewhere(const Facts& around) {
  const auto look = [&](const std::string& name) {
    const auto at = around.mentions.find(name);
    if (at == around.mentions.end()) return;
    for (const Facts::Place& place : at->second)
      if (place.file != program_->sources[0].file)
        spoil(name, fmt::format("{}:{}", place.file, place.line));
  };
  for (const auto& [name, target] : index_) look(name);
  for (const auto& [name, frame] : frames_) look(name);
  if (around.displaced.empty()) return;
  for (Target& target : program_->targets)
    target.leave(around.displaced,
                 "take that out, or filter apart the programs that do not run with it");
}

void Names::displace(const Tokens& tokens, std::size_t i) {
  if (!program_->facts.displaced.empty()) return;
  program_->facts.displaced =
      fmt::format("{} in {}:{} moves all targets while the program runs", tokens.text(i),
                  program_->sources[tokens.source()].file, tokens.line(i));
}

}  // namespace plumb::offline::programs

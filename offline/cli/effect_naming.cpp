// SPDX-License-Identifier: Apache-2.0
#include "cli/effect_naming.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline::cli {
namespace {

[[noreturn]] void refuse(const char* code, const std::string& message, const std::string& word,
                         const std::vector<std::string>& known, const std::string& otherwise) {
  const auto guess = did_you_mean(word, known);
  throw Failure(Exit::kUsage,
                {.code = code,
                 .message = message,
                 .help = guess ? fmt::format("did you mean '{}'?", *guess) : otherwise});
}

}  // namespace

void require_effect(const std::string& name, const char* code) {
  const auto& known = known_effects();
  if (std::find(known.begin(), known.end(), name) == known.end())
    refuse(code, fmt::format("there is no effect '{}'", name), name, known,
           "plumb explain lists the effects");
}

int joint_named(const Cell& cell, const std::string& name, const char* code) {
  std::vector<std::string> all;
  for (const auto& joint : cell.nominal.joints) {
    if (joint.name == name) return static_cast<int>(all.size());
    all.push_back(joint.name);
  }
  refuse(code, fmt::format("the arm has no joint '{}'", name), name, all,
         fmt::format("its joints: {}", fmt::join(all, ", ")));
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#include "cli/effect_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace plumb::offline::cli {
namespace {

[[noreturn]] void refuse(std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = "E-USAGE", .message = std::move(message), .help = std::move(help)});
}

int joint_of(const Cell& cell, const std::string& name) {
  std::vector<std::string> all;
  for (int j = 0; j < cell.joints(); ++j) {
    if (cell.nominal.joints[j].name == name) return j;
    all.push_back(cell.nominal.joints[j].name);
  }
  const auto guess = did_you_mean(name, all);
  refuse(fmt::format("--joints: the arm has no joint '{}'", name),
         guess ? fmt::format("did you mean '{}'?", *guess)
               : fmt::format("its joints: {}", fmt::join(all, ", ")));
}

/// A number where it reads as one; a share like "2%" stays a text for the reader to judge.
EffectEntry::Value value_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  if (const auto share = parse_percent(text)) return *share;
  return text;
}

}  // namespace

void EffectOptions::add_to(CLI::App& verb) {
  verb.add_option("EFFECT", name, "Name in the catalogue: plumb explain lists them")->required();
  verb.add_option("--joints", joints, "Only these joints: J2,J3")->delimiter(',');
  verb.add_option("--set", set, "An option of the effect, such as cycles_per_turn=20")
      ->type_name("KEY=VALUE");
}

EffectEntry EffectOptions::entry(const Cell& cell) const {
  const auto& known = known_effects();
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    const auto guess = did_you_mean(name, known);
    refuse(fmt::format("there is no effect '{}'", name),
           guess ? fmt::format("did you mean '{}'?", *guess) : "plumb explain lists the effects");
  }
  EffectEntry out{.name = name, .joints = {}, .options = {}, .place = {}};
  for (const auto& joint : joints) out.joints.push_back(joint_of(cell, joint));
  for (const auto& text : set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      refuse(fmt::format("--set: '{}' is not KEY=VALUE", text), "--set cycles_per_turn=20");
    out.options[text.substr(0, equals)] = value_of(text.substr(equals + 1));
  }
  return out;
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#include "cli/effect_argument.hpp"

#include <fmt/format.h>

#include "cell/effect_option.hpp"
#include "cell/effects_edit.hpp"
#include "cli/effect_naming.hpp"
#include "cli/parts.hpp"
#include "effects/registry.hpp"

namespace plumb::offline::cli {
namespace {

constexpr const char* kCode = "E-PLAN-EFFECT";
constexpr const char* kExample = "plumb plan --separate reversal:J2,settling_lag:J2";

[[noreturn]] void refuse(const std::string& message, const std::string& help = kExample) {
  throw Failure(Exit::kUsage, {.code = kCode, .message = message, .help = help});
}

void read_number(const std::string& text, EffectEntry& out) {
  const auto equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const EffectOption* option = find_option(out.name, key);
  const auto value = option == nullptr || equals == std::string::npos
                         ? std::nullopt
                         : option_value(*option, text.substr(equals + 1));
  if (!value || !std::holds_alternative<double>(*value))
    refuse(option == nullptr ? fmt::format("'@{}' is no KEY=NUMBER of {}", text, out.name)
                             : fmt::format("'@{}': '{}' must be {}", text, key, option->rule),
           "plumb plan --separate gear_ripple:J2@cycles_per_turn=20,gear_harmonics:J2");
  out.options[key] = *value;
}

EffectEntry one_effect(const Cell& cell, const std::string& text) {
  const auto numbers = parts(text, '@');
  const auto colon = numbers[0].find(':');
  EffectEntry out;
  out.name = numbers[0].substr(0, colon);
  require_effect(out.name, kCode);
  if (colon != std::string::npos)
    for (const auto& joint : parts(numbers[0].substr(colon + 1), '+'))
      out.joints.push_back(joint_named(cell, joint, kCode));
  for (const auto& listed : cell.effects)
    if (listed.name == out.name && (out.joints.empty() || listed.joints == out.joints)) {
      out.joints = listed.joints;
      out.options = listed.options;
      break;
    }
  for (std::size_t k = 1; k < numbers.size(); ++k) read_number(numbers[k], out);
  if (is_geometry(out.name) || is_local_tree(out.name))
    refuse(fmt::format("{} is no single effect, so nothing can be separated from it", out.name));
  if (const std::string fault = joints_fault(out, cell.nominal); !fault.empty())
    refuse(fmt::format("{} {}", out.name, fault),
           "plumb plan --separate cross_compliance:J3+J2,joint_compliance:J2");
  if (is_wave(out.name) && !has_option(out, OptionKey::kCyclesPerTurn))
    refuse("gear_ripple needs its cycles a turn",
           "plumb plan --separate gear_ripple:J2@cycles_per_turn=20,gear_harmonics:J2");
  return out;
}

}  // namespace

std::vector<EffectEntry> two_effects(const Cell& cell, const std::string& text) {
  std::vector<EffectEntry> out;
  for (const auto& part : parts(text, ',')) out.push_back(one_effect(cell, part));
  if (out.size() != 2)
    refuse(fmt::format("--separate takes two effects, not {}; join joints by '+'", out.size()));
  if (same_effect(out[0], out[1])) refuse("--separate takes two different effects");
  return out;
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#include "cli/effect_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/effect_option.hpp"
#include "cli/effect_naming.hpp"
#include "cli/parts.hpp"
#include "effects/registry.hpp"
#include "program/shell_word.hpp"
#include "program/utf8.hpp"

namespace plumb::offline::cli {
namespace {

constexpr const char* kUsageCode = "E-USAGE";

[[noreturn]] void refuse_option(std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = kUsageCode, .message = std::move(message), .help = std::move(help)});
}

[[noreturn]] void refuse_option(std::string message, std::string given, std::string help) {
  Problem problem{
      .code = "E-EFFECT-OPTION", .message = std::move(message), .help = std::move(help)};
  if (!given.empty()) problem.place.emplace().file = std::move(given);
  throw Failure(Exit::kUsage, std::move(problem));
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// "7.91, 17.49"
std::vector<std::string> list(const std::string& text) {
  std::vector<std::string> out = parts(text, ',');
  for (auto& part : out) part = trimmed(part);
  return out;
}

const EffectOption& option_named(const std::string& effect, const std::string& key,
                                 const std::string& given) {
  if (const auto* option = find_option(effect, key)) return *option;
  std::vector<std::string> known;
  for (const auto& option : options_of(effect)) known.emplace_back(option.name());
  const auto guess = did_you_mean(key, known);
  refuse_option(fmt::format("{} has no option '{}'", effect, key), given,
                guess           ? fmt::format("did you mean '{}'?", *guess)
                : known.empty() ? "leave it out: it takes no options"
                                : fmt::format("its options: {}", fmt::join(known, ", ")));
}

/// Each effect of `entries` with each of the values of "KEY=VALUE,VALUE".
std::vector<EffectEntry> with_option(const std::vector<EffectEntry>& entries,
                                     const std::string& text) {
  const std::string& effect = entries.front().name;
  const std::string given = "--set " + shell_word(text);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse_option(fmt::format("--set: '{}' is not KEY=VALUE", text), "--set cycles_per_turn=20");
  const std::string key = text.substr(0, equals), values = text.substr(equals + 1);
  const EffectOption& option = option_named(effect, key, given);
  std::vector<EffectEntry> out;
  for (const auto& part : option.lists ? list(values) : std::vector<std::string>{values}) {
    const auto value = option_value(option, part);
    if (!value)
      refuse_option(fmt::format("'{}' of {} must be {}{}", key, effect, option.rule,
                                option.lists ? "; several with commas between" : ""),
                    given, fmt::format("--set {}={}", key, option.example));
    for (EffectEntry entry : entries) {
      entry.options[key] = *value;
      if (std::any_of(out.begin(), out.end(),
                      [&](const EffectEntry& other) { return other.options == entry.options; }))
        refuse_option(fmt::format("'{}' of {} is given twice: {}", key, effect, part), given,
                      "leave one out");
      out.push_back(std::move(entry));
    }
  }
  return out;
}

/// What a whole effect cannot do without.
void check_whole(const Cell& cell, const EffectEntry& entry, const std::string& joints) {
  for (const auto& option : options_of(entry.name))
    if (option.required && !has_option(entry, option.key))
      refuse_option(fmt::format("{} needs '{}': {}", entry.name, option.name(), option.rule), "",
                    fmt::format("--set {}={}", option.name(), option.example));
  if (const std::string fault = joints_fault(entry, cell.nominal); !fault.empty())
    refuse_option(fmt::format("{} {}", entry.name, fault),
                  joints.empty() ? "" : "--joints " + joints,
                  entry.joints.empty() ? "--joints J2,J3" : "plumb explain " + entry.name);
}

/// "dq2 = k * tau2": what moves, and by how much.
void set_law(const std::string& formula, EffectEntry& out) {
  const std::size_t equals = formula.find('=');
  if (equals == std::string::npos)
    refuse_option(fmt::format("--formula: '{}' is not TARGET = EXPRESSION", formula),
                  kFormulaExample);
  out.options["target"] = trimmed(formula.substr(0, equals));
  out.options["expression"] = trimmed(formula.substr(equals + 1));
}

}  // namespace

void EffectOptions::add_to(VerbOptions& verb, bool law_too) {
  verb.add_option("EFFECT", name, "Name in the catalogue: plumb explain lists them").required();
  verb.add_option("--joints", joints, "Only these joints: J2,J3").delimiter(',');
  verb.add_option("--set", set, "An option of the effect, such as cycles_per_turn=20")
      .type_name("KEY=VALUE");
  verb.add_option("--name", formula_name, "Which formula, if there are several").type_name("NAME");
  if (!law_too) return;
  verb.add_option("--formula", formula, "A law of your own: \"dq2 = k * tau2\"").type_name("LAW");
  verb.add_option("--parameter", parameters,
                  "One of its parameters: name, unit, typical size: \"k [rad/(N m)] ~ 1e-6\"")
      .type_name("TEXT");
  verb.add_option("--domain", domain, "What it belongs to: robot (default), environment, ...")
      .type_name("WORD");
}

std::vector<EffectEntry> EffectOptions::to_drop(const Cell& cell) const {
  require_effect(name, kUsageCode);
  const bool lawful = !formula.empty() || !parameters.empty() || !domain.empty();
  if (!is_formula(name) && (lawful || !formula_name.empty()))
    refuse_option(
        fmt::format("--formula, --parameter, --name and --domain belong to 'formula', not to {}",
                    name),
        kFormulaExample);
  if (is_formula(name) && !joints.empty())
    refuse_option("a formula says itself which joints it reads and moves", kFormulaExample);
  EffectEntry one{.name = name, .joints = {}, .options = {}, .place = {}};
  for (const auto& joint : joints) one.joints.push_back(joint_named(cell, joint, kUsageCode));
  if (!formula.empty()) set_law(formula, one);
  if (!parameters.empty()) one.options["parameters"] = parameters;
  if (!formula_name.empty()) one.options["name"] = formula_name;
  if (!domain.empty()) one.options["domain"] = domain;
  std::vector<EffectEntry> out{std::move(one)};
  for (const auto& text : set) out = with_option(out, text);
  return out;
}

std::vector<EffectEntry> EffectOptions::to_add(const Cell& cell) const {
  auto out = to_drop(cell);
  for (auto& entry : out) {
    fill_in_usual(entry);
    check_whole(cell, entry, fmt::format("{}", fmt::join(joints, ",")));
  }
  if (is_formula(name) && formula.empty()) refuse_option("formula needs a law", kFormulaExample);
  return out;
}

std::string EffectOptions::option_at(const Place& place) const {
  const std::string line = trimmed(place.source);
  if (line.starts_with("parameters"))
    return fmt::format("--parameter {}",
                       shell_word(fmt::format("{}", fmt::join(parameters, ", "))));
  if (line.starts_with("name")) return "--name " + shell_word(formula_name);
  if (line.starts_with("domain")) return "--domain " + shell_word(domain);
  if (is_formula(name)) return "--formula " + shell_word(formula);
  return set.empty() ? name : "--set " + shell_word(fmt::format("{}", fmt::join(set, " --set ")));
}

Place EffectOptions::place_at(const Place& place) const {
  Place out{.file = option_at(place)};
  const std::string line = trimmed(place.source);
  const bool target = line.starts_with("target");
  const std::size_t quote = place.source.find('"'), equals = formula.find('=');
  if (quote == std::string::npos || equals == std::string::npos ||
      !(target || line.starts_with("expression")))
    return out;
  const int in_text = place.column - 2 - count_characters(place.source.substr(0, quote));
  const std::size_t from = formula.find_first_not_of(" \t", target ? 0 : equals + 1);
  if (in_text < 0 || from == std::string::npos) return out;
  out.column = 1 + count_characters(formula.substr(0, from)) + in_text;
  return out;
}

}  // namespace plumb::offline::cli

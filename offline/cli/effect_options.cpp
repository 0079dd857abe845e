// SPDX-License-Identifier: Apache-2.0
#include "cli/effect_options.hpp"

#include <fmt/format.h>

#include <charconv>

#include "cli/effect_naming.hpp"

namespace plumb::offline::cli {
namespace {

constexpr const char* kUsageCode = "E-USAGE";

[[noreturn]] void refuse(std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = kUsageCode, .message = std::move(message), .help = std::move(help)});
}

/// A number where it reads as one; a share like "2%" too; else the text, for the reader to judge.
EffectEntry::Value value_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  if (const auto share = parse_percent(text)) return *share;
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// "dq2 = k * tau2": what moves, and by how much.
void set_law(const std::string& formula, EffectEntry& out) {
  const std::size_t equals = formula.find('=');
  if (equals == std::string::npos)
    refuse(fmt::format("--formula: '{}' is not TARGET = EXPRESSION", formula), kFormulaExample);
  out.options["target"] = trimmed(formula.substr(0, equals));
  out.options["expression"] = trimmed(formula.substr(equals + 1));
}

}  // namespace

void EffectOptions::add_to(CLI::App& verb, bool law_too) {
  verb.add_option("EFFECT", name, "Name in the catalogue: plumb explain lists them")->required();
  verb.add_option("--joints", joints, "Only these joints: J2,J3")->delimiter(',');
  verb.add_option("--set", set, "An option of the effect, such as cycles_per_turn=20")
      ->type_name("KEY=VALUE");
  verb.add_option("--name", formula_name, "Which formula, if there are several")->type_name("NAME");
  if (!law_too) return;
  verb.add_option("--formula", formula, "A law of your own: \"dq2 = k * tau2\"")->type_name("LAW");
  verb.add_option("--parameter", parameters,
                  "One of its parameters: name, unit, typical size: \"k [rad/(N m)] ~ 1e-6\"")
      ->type_name("TEXT");
  verb.add_option("--domain", domain, "What it belongs to: robot (default), environment, ...")
      ->type_name("WORD");
}

EffectEntry EffectOptions::entry(const Cell& cell) const {
  require_effect(name, kUsageCode);
  const bool lawful = !formula.empty() || !parameters.empty() || !domain.empty();
  if (name != "formula" && (lawful || !formula_name.empty()))
    refuse(fmt::format("--formula, --parameter, --name and --domain belong to 'formula', not to {}",
                       name),
           kFormulaExample);
  if (name == "formula" && !joints.empty())
    refuse("a formula says itself which joints it reads and moves", kFormulaExample);
  EffectEntry out{.name = name, .joints = {}, .options = {}, .place = {}};
  for (const auto& joint : joints) out.joints.push_back(joint_named(cell, joint, kUsageCode));
  for (const auto& text : set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      refuse(fmt::format("--set: '{}' is not KEY=VALUE", text), "--set cycles_per_turn=20");
    out.options[text.substr(0, equals)] = value_of(text.substr(equals + 1));
  }
  if (!formula.empty()) set_law(formula, out);
  if (!parameters.empty()) out.options["parameters"] = parameters;
  if (!formula_name.empty()) out.options["name"] = formula_name;
  if (!domain.empty()) out.options["domain"] = domain;
  return out;
}

}  // namespace plumb::offline::cli

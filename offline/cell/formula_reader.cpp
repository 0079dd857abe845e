// SPDX-License-Identifier: Apache-2.0
#include "cell/formula_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "effects/registry.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

using Kind = FormulaProblem::Kind;
using Field = FormulaProblem::Field;

const char* code_of(Kind kind) {
  switch (kind) {
    case Kind::kSyntax:
      return "E-FORMULA-SYNTAX";
    case Kind::kVariable:
      return "E-FORMULA-VARIABLE";
    case Kind::kUnit:
      return "E-FORMULA-UNIT";
    case Kind::kNoNumber:
      return "E-FORMULA-NUMBER";
    case Kind::kTooLong:
      return "E-FORMULA-LONG";
    case Kind::kParameter:
      return "E-FORMULA-PARAMETER";
    case Kind::kTarget:
      return "E-FORMULA-TARGET";
    default:
      return "E-FORMULA-DOMAIN";
  }
}

/// Byte of the line where a column, counted in characters from 1, begins.
std::size_t byte_of(const std::string& line, int column) {
  std::size_t at = 0;
  for (int i = 1; i < column && at < line.size(); ++i) do
      ++at;
    while (at < line.size() && (static_cast<unsigned char>(line[at]) & 0xC0U) == 0x80U);
  return at;
}

/// Moves from a text in quotes into it. A text with escapes or over several lines keeps its place.
Place inside(Place place, const std::string& text, std::size_t at, std::size_t length) {
  const std::size_t quote = byte_of(place.source, place.column);
  if (quote >= place.source.size() || (place.source[quote] != '"' && place.source[quote] != '\'') ||
      place.source.compare(quote + 1, text.size(), text) != 0)
    return place;
  const std::string_view all = text;
  at = std::min(at, all.size());
  place.column += 1 + count_characters(all.substr(0, at));
  place.length = std::max(1, count_characters(all.substr(at, length)));
  return place;
}

/// The texts of an entry and where each stands.
class FormulaEntry {
 public:
  FormulaEntry(TomlTable& table, EffectEntry& entry) : table_(table) {
    const auto keep = [&](const char* key, const char* example) {
      if (const auto text = table.text(key))
        entry.options[key] = *text;
      else if (table.node(key) == nullptr && example != nullptr)
        table.missing(key, fmt::format("{} = \"{}\"", key, example));
      return table.node(key);
    };
    name_ = keep("name", nullptr);
    target_ = keep("target", "dq2");
    expression_ = keep("expression", "k * tau2");
    if (table.node("domain") != nullptr)
      entry.options["domain"] = table.choice("domain", formula_domains());
    std::vector<std::string> texts;
    for (const auto& [text, node] : table.texts("parameters")) {
      texts.push_back(text);
      parameters_.push_back(node);
    }
    if (!texts.empty()) entry.options["parameters"] = texts;
    text_ = formula_text(entry);
  }

  bool complete() const { return !text_.target.empty() && expression_ != nullptr; }
  const FormulaText& text() const { return text_; }
  const toml::node* name() const { return name_ != nullptr ? name_ : target_; }

  void report(const FormulaProblem& p) {
    const auto [node, text] = field(p);
    const auto guess = p.word.empty() ? std::nullopt : did_you_mean(p.word, p.candidates);
    const std::string label = guess ? fmt::format("did you mean '{}'?", *guess) : p.label;
    Place place = inside(table_.source().place(node->source(), label), text, p.at, p.length);
    table_.source().problems().error(code_of(p.kind), p.message, std::move(place),
                                     guess ? fmt::format("write '{}'", *guess) : p.help);
  }

 private:
  std::pair<const toml::node*, std::string> field(const FormulaProblem& p) const {
    if (p.field == Field::kTarget) return {target_, text_.target};
    if (p.field == Field::kExpression) return {expression_, text_.expression};
    return {parameters_[p.parameter], text_.parameters[p.parameter]};
  }

  TomlTable& table_;
  FormulaText text_;
  const toml::node* name_ = nullptr;
  const toml::node* target_ = nullptr;
  const toml::node* expression_ = nullptr;
  std::vector<const toml::node*> parameters_;
};

void check_name(TomlTable& table, const FormulaEntry& entry, const CellDraft& draft) {
  const std::string label = formula_label(entry.text());
  if (!is_plain_name(label))
    table.error("E-FORMULA-NAME", fmt::format("'{}' is no name for a formula", label),
                *entry.name(), "letters, digits and _", "name = \"motor_heat\"");
  for (const auto& other : draft.cell.effects)
    if (is_formula(other.name) && formula_label(formula_text(other)) == label)
      table.error("E-FORMULA-NAME", fmt::format("two formulas are called '{}'", label),
                  *entry.name(), "the second one", fmt::format("name = \"{}_2\"", label));
}

}  // namespace

FormulaText formula_text(const EffectEntry& entry) {
  const auto text = [&](const char* key) {
    const auto it = entry.options.find(key);
    const auto* found = it == entry.options.end() ? nullptr : std::get_if<std::string>(&it->second);
    return found != nullptr ? *found : std::string();
  };
  FormulaText out{.name = text("name"),
                  .target = text("target"),
                  .expression = text("expression"),
                  .parameters = {}};
  if (const std::string domain = text("domain"); !domain.empty()) out.domain = domain;
  if (const auto it = entry.options.find("parameters"); it != entry.options.end())
    if (const auto* all = std::get_if<std::vector<std::string>>(&it->second)) out.parameters = *all;
  return out;
}

FormulaArm formula_arm(const format::Chain& nominal) {
  FormulaArm out;
  for (const auto& row : nominal.joints)
    out.slides.push_back(row.type == format::JointType::kPrismatic);
  return out;
}

void read_formula(TomlTable& table, CellDraft& draft, EffectEntry& entry) {
  FormulaEntry read(table, entry);
  if (!read.complete()) return;
  check_name(table, read, draft);
  FormulaProblems problems;
  compile_formula(read.text(), formula_arm(draft.cell.nominal), problems);
  for (const auto& problem : problems) read.report(problem);
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cell/cell_sections.hpp"
#include "cell/effect_option.hpp"
#include "cell/formula_reader.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// True if this version can fit it; else says why not.
bool is_known(TomlTable& t, const std::string& name) {
  if (holds(known_effects(), name)) return true;
  const toml::node& node = *t.node(name);
  const auto guess = did_you_mean(name, known_effects());
  t.error("E-CELL-EFFECT", fmt::format("unknown effect '{}'", name), node,
          guess ? fmt::format("did you mean '{}'?", *guess) : "not in the catalogue",
          guess ? fmt::format("rename it to [effects.{}]", *guess)
                : fmt::format("delete [effects.{}]", name));
  return false;
}

void read_option(const EffectOption& option, TomlTable& t, EffectEntry& entry) {
  const std::string key = option.name();
  const toml::node* node = t.node(key);
  if (node == nullptr) {
    if (option.required)
      t.missing(key, fmt::format("add {} = {} to [effects.{}]", key, option.example, entry.name));
    return;
  }
  const auto keep = [&](const auto& value, bool good) {
    if (good)
      entry.options[key] = value;
    else
      t.out_of_range(key, option.rule);
  };
  if (option.takes == EffectOption::Takes::kText || option.takes == EffectOption::Takes::kWord) {
    if (const auto text = t.text(key)) keep(*text, makes_sense(option, *text));
  } else if (option.takes == EffectOption::Takes::kShare && node->is_string()) {
    const auto share = parse_percent(*node->value<std::string>());
    keep(share.value_or(0.0), share && makes_sense(option, *share));
  } else if (const auto number = t.number(key)) {
    keep(*number, makes_sense(option, *number));
  }
}

constexpr const char* kSlidesHelp =
    "delete it; a joint that slides has type = \"prismatic\" in [robot]";

bool is_of_slides(const std::string& effect) {
  const EffectDescriptor* found = find_descriptor(effect);
  return found != nullptr && found->joints == JointList::kSliding;
}

void read_joints(TomlTable& t, CellDraft& draft, EffectEntry& entry) {
  bool known = true;
  for (const auto& [joint, node] : t.texts("joints")) {
    const int index = draft.joint_index(joint);
    known = known && index >= 0;
    if (index < 0)
      unknown_joint(t, joint, *node, draft);
    else
      entry.joints.push_back(index);
  }
  const std::string fault = joints_fault(entry, draft.cell.nominal);
  if (fault.empty() || !known) return;
  const std::string message = fmt::format("effect '{}' {}", entry.name, fault);
  const std::string help = is_of_slides(entry.name) ? kSlidesHelp
                           : entry.joints.empty()
                               ? fmt::format("add joints = [...] to [effects.{}]", entry.name)
                               : "correct the list, or delete it";
  if (const toml::node* node = t.node("joints"))
    t.error("E-CELL-JOINT", message, *node, "not these", help);
  else
    t.source().problems().error("E-CELL-JOINT", message, t.place("belongs here"), help);
}

void read_effect(const std::string& name, TomlTable& t, CellDraft& draft) {
  EffectEntry entry{.name = name, .joints = {}, .options = {}, .place = t.place("")};
  if (is_formula(name)) {
    read_formula(t, draft, entry);
    t.done();
    draft.cell.effects.push_back(std::move(entry));
    return;
  }
  for (const EffectOption& option : options_of(name)) read_option(option, t, entry);
  fill_in_usual(entry);
  read_joints(t, draft, entry);
  t.done();
  draft.cell.effects.push_back(std::move(entry));
}

/// An effect that is only switched on: NAME = true.
void read_plain(const std::string& name, const toml::node& node, TomlTable& t, CellDraft& draft) {
  EffectEntry entry{
      .name = name, .joints = {}, .options = {}, .place = t.source().place(node.source(), "")};
  for (const EffectOption& option : options_of(name))
    if (option.required)
      return t.error("E-CELL-MISSING", fmt::format("effect '{}' needs '{}'", name, option.name()),
                     node, "a table is needed",
                     fmt::format("{} = {{ {} = {} }}", name, option.name(), option.example));
  if (const std::string fault = joints_fault(entry, draft.cell.nominal); !fault.empty())
    return t.error("E-CELL-JOINT", fmt::format("effect '{}' {}", name, fault), node,
                   "a table is needed",
                   is_of_slides(name) ? kSlidesHelp
                                      : fmt::format("{} = {{ joints = [\"J2\", \"J3\"] }}", name));
  draft.cell.effects.push_back(std::move(entry));
}

void read_entries(const std::string& name, TomlTable& t, CellDraft& draft) {
  const toml::node& node = *t.node(name);
  if (node.is_array()) {
    for (auto& entry : t.tables(name)) read_effect(name, entry, draft);
  } else if (node.is_boolean() && !is_formula(name)) {
    if (*node.value<bool>()) read_plain(name, node, t, draft);
  } else if (auto entry = t.table(name)) {
    read_effect(name, *entry, draft);
  }
}

}  // namespace

void read_effects(TomlTable& t, CellDraft& draft) {
  if (!t.boolean("geometry").value_or(true)) draft.cell.effects.clear();
  for (const auto& name : t.keys())
    if (!is_geometry(name) && is_known(t, name)) read_entries(name, t, draft);
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cell/cell_sections.hpp"
#include "cell/formula_reader.hpp"

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

void read_min_gain(TomlTable& t, EffectEntry& entry) {
  const toml::node* node = t.node("min_gain");
  if (node == nullptr) return;
  double gain = -1.0;
  if (node->is_string()) gain = parse_percent(*node->value<std::string>()).value_or(-1.0);
  if (node->is_number()) gain = node->value<double>().value_or(-1.0);
  if (gain >= 0.0 && gain < 1.0)
    entry.options["min_gain"] = gain;
  else
    t.out_of_range("min_gain", "a share like \"2%\" or 0.02");
}

/// Words and numbers that say what kind of tree is wanted.
void read_tree_options(TomlTable& t, EffectEntry& entry) {
  const auto word = [&](const char* key, const char* usual, const char* other) {
    if (t.node(key) == nullptr) return;
    const auto text = t.text(key);
    if (text && (*text == usual || *text == other))
      entry.options[key] = *text;
    else
      t.out_of_range(key, fmt::format("\"{}\" or \"{}\"", usual, other));
  };
  read_min_gain(t, entry);
  word("form", "blended", "crisp");
  word("splits", "shared", "own");
  if (t.node("degree") == nullptr) return;
  const auto degree = t.number("degree");
  if (degree && (*degree == 1.0 || *degree == 2.0))
    entry.options["degree"] = *degree;
  else
    t.out_of_range("degree", "1 (affine leaves) or 2 (quadratic ones too)");
}

/// A number or a text that an effect may be given.
struct Option {
  const char* effect;
  const char* key;
  bool is_text = false;
  bool required = false;
};

constexpr Option kOptions[] = {{"gear_ripple", "cycles_per_turn", false, true},
                               {"joint_compliance_soft", "torque_Nm"},
                               {"backlash_load", "torque_Nm"},
                               {"reversal", "transition_deg"},
                               {"drift", "settling_s"},
                               {"thermal_growth", "sensor", true},
                               {"thermal_growth", "reference_degC"},
                               {"step", "after_row", false, true},
                               {"step", "of", true},
                               {"gravity_compensator", "length_ratio"},
                               {"gravity_compensator", "anchor_ratio"}};

void read_options(const std::string& name, TomlTable& t, EffectEntry& entry) {
  for (const auto& option : kOptions) {
    if (name != option.effect) continue;
    if (option.is_text) {
      if (const auto text = t.text(option.key)) entry.options[option.key] = *text;
    } else if (const auto number = t.number(option.key)) {
      entry.options[option.key] = *number;
    } else if (option.required && t.node(option.key) == nullptr) {
      t.missing(option.key, fmt::format("add {} = 1 to [effects.{}]", option.key, name));
    }
  }
}

void read_effect(const std::string& name, TomlTable& t, CellDraft& draft) {
  EffectEntry entry{.name = name, .joints = {}, .options = {}, .place = t.place("")};
  if (name == "formula") {
    read_formula(t, draft, entry);
    t.done();
    draft.cell.effects.push_back(std::move(entry));
    return;
  }
  for (const auto& [joint, node] : t.texts("joints")) {
    const int index = draft.joint_index(joint);
    if (index < 0)
      unknown_joint(t, joint, *node, draft);
    else
      entry.joints.push_back(index);
  }
  if (name == "local_tree") read_tree_options(t, entry);
  read_options(name, t, entry);
  t.done();
  draft.cell.effects.push_back(std::move(entry));
}

void read_entries(const std::string& name, TomlTable& t, CellDraft& draft) {
  const toml::node& node = *t.node(name);
  if (node.is_array()) {
    for (auto& entry : t.tables(name)) read_effect(name, entry, draft);
  } else if (node.is_boolean() && name != "formula") {
    if (*node.value<bool>())
      draft.cell.effects.push_back({.name = name,
                                    .joints = {},
                                    .options = {},
                                    .place = t.source().place(node.source(), "")});
  } else if (auto entry = t.table(name)) {
    read_effect(name, *entry, draft);
  }
}

}  // namespace

void read_effects(TomlTable& t, CellDraft& draft) {
  if (!t.boolean("geometry").value_or(true)) draft.cell.effects.clear();
  for (const auto& name : t.keys())
    if (name != "geometry" && is_known(t, name)) read_entries(name, t, draft);
}

}  // namespace plumb::offline

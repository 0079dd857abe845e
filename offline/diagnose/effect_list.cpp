// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_list.hpp"

#include <algorithm>

#include "cell/formula_reader.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// Effects that apply to each of their joints separately. Any other effect is defined by all of its
/// joints together.
bool joints_add_up(const EffectEntry& entry) {
  const JointList list = descriptor_of(entry.name).joints;
  return !entry.joints.empty() && list != JointList::kOrderedPair &&
         list != JointList::kOneIfEncoder && list != JointList::kInFormula;
}

bool like(const EffectEntry& a, const EffectEntry& b) {
  if (a.name != b.name) return false;
  if (const auto name = b.options.find("name"); is_formula(b.name) && name != b.options.end())
    return name->second == EffectEntry::Value(formula_label(formula_text(a)));
  return std::all_of(b.options.begin(), b.options.end(), [&](const auto& option) {
    const auto it = a.options.find(option.first);
    return it != a.options.end() && it->second == option.second;
  });
}

bool contains(const std::vector<int>& all, int joint) {
  return std::find(all.begin(), all.end(), joint) != all.end();
}

}  // namespace

std::vector<EffectEntry> with_effect(std::vector<EffectEntry> effects, const EffectEntry& entry) {
  if (joints_add_up(entry))
    for (auto& old : effects)
      if (old.name == entry.name && old.options == entry.options && !old.joints.empty()) {
        for (int joint : entry.joints)
          if (!contains(old.joints, joint)) old.joints.push_back(joint);
        std::sort(old.joints.begin(), old.joints.end());
        return effects;
      }
  effects.push_back(entry);
  return effects;
}

std::vector<EffectEntry> without_effect(std::vector<EffectEntry> effects,
                                        const EffectEntry& entry) {
  std::vector<EffectEntry> out;
  for (auto& old : effects) {
    if (!like(old, entry)) {
      out.push_back(std::move(old));
      continue;
    }
    if (entry.joints.empty() || old.joints == entry.joints) continue;
    if (!joints_add_up(old)) {
      out.push_back(std::move(old));
      continue;
    }
    std::erase_if(old.joints, [&](int joint) { return contains(entry.joints, joint); });
    if (!old.joints.empty()) out.push_back(std::move(old));
  }
  return out;
}

std::vector<EffectEntry> taken_out(const std::vector<EffectEntry>& before,
                                   const std::vector<EffectEntry>& after) {
  std::vector<EffectEntry> out;
  for (const auto& old : before) {
    const auto left = std::find_if(after.begin(), after.end(), [&](const EffectEntry& e) {
      return e.name == old.name && e.options == old.options &&
             std::all_of(e.joints.begin(), e.joints.end(),
                         [&](int joint) { return contains(old.joints, joint); }) &&
             e.joints.empty() == old.joints.empty();
    });
    EffectEntry gone = old;
    if (left != after.end())
      std::erase_if(gone.joints, [&](int joint) { return contains(left->joints, joint); });
    if (left == after.end() || !gone.joints.empty()) out.push_back(std::move(gone));
  }
  return out;
}

bool all_slide(const Cell& cell, const EffectEntry& entry) {
  return !entry.joints.empty() &&
         std::all_of(entry.joints.begin(), entry.joints.end(), [&](int joint) {
           const auto& row = cell.nominal.joints[static_cast<std::size_t>(joint)];
           return row.type == format::JointType::kPrismatic;
         });
}

bool has_effect(const std::vector<EffectEntry>& effects, const EffectEntry& entry) {
  return std::any_of(effects.begin(), effects.end(), [&](const EffectEntry& old) {
    if (old.name != entry.name || old.options != entry.options) return false;
    if (old.joints.empty() || old.joints == entry.joints) return true;
    return joints_add_up(entry) &&
           std::all_of(entry.joints.begin(), entry.joints.end(),
                       [&](int joint) { return contains(old.joints, joint); });
  });
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_sentence.hpp"

#include <fmt/format.h>

#include "diagnose/diagnosis_text.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

std::string joints_of(const Cell& cell, const EffectEntry& entry) {
  std::string out;
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out += (i == 0                         ? ""
            : i + 1 == entry.joints.size() ? " and "
                                           : ", ") +
           cell.nominal.joints[entry.joints[i]].name;
  return out;
}

}  // namespace

std::string effect_sentence(const Cell& cell, const EffectEntry& entry,
                            const std::vector<double>& cycles) {
  const EffectDescriptor* effect = find_descriptor(entry.name);
  if (effect == nullptr || *effect->sentence == '\0') return in_words(cell, entry, cycles);
  const std::string joints = joints_of(cell, entry);
  return fmt::format(fmt::runtime(effect->sentence), joints.empty() ? "the joints" : joints,
                     entry.joints.size() == 1 ? "s" : "", waves_words(cycles));
}

}  // namespace plumb::offline

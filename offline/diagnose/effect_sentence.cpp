// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>

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

bool all_below_zero(const std::vector<CandidateNumber>& numbers) {
  return !numbers.empty() && std::all_of(numbers.begin(), numbers.end(),
                                         [](const CandidateNumber& n) { return n.value < 0.0; });
}

std::string filled_in(const Cell& cell, const EffectEntry& entry, const std::vector<double>& cycles,
                      const char* sentence) {
  const std::string joints = joints_of(cell, entry);
  const bool one = entry.joints.size() == 1;
  return fmt::format(fmt::runtime(sentence), joints.empty() ? "the joints" : joints, one ? "s" : "",
                     waves_words(cycles), one ? "is" : "are");
}

}  // namespace

std::string effect_sentence(const Cell& cell, const EffectEntry& entry,
                            const std::vector<double>& cycles) {
  const EffectDescriptor* effect = find_descriptor(entry.name);
  if (effect == nullptr || *effect->sentence == '\0') return in_words(cell, entry, cycles);
  return filled_in(cell, entry, cycles, effect->sentence);
}

std::string effect_sentence(const Cell& cell, const Candidate& candidate) {
  const EffectDescriptor* effect = find_descriptor(candidate.entry.name);
  if (effect != nullptr && effect->negative_sentence != nullptr &&
      all_below_zero(candidate.numbers))
    return filled_in(cell, candidate.entry, candidate.cycles, effect->negative_sentence);
  return effect_sentence(cell, candidate.entry, candidate.cycles);
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/effect_list.hpp"
#include "diagnose/effect_words.hpp"
#include "effects/registry.hpp"
#include "noise/moving_part.hpp"

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

std::string joint_name(const Cell& cell, const EffectEntry& entry, std::size_t place) {
  return place < entry.joints.size() ? cell.nominal.joints[entry.joints[place]].name : "";
}

/// Why a law that knows no masses stands where the weights act.
const char* masses_words(const Cell& cell) {
  const bool given = std::any_of(cell.mechanics.begin(), cell.mechanics.end(),
                                 [](const JointMechanics& joint) { return joint.has_mass(); });
  return given ? "as if the masses were not those of cell.toml" : "masses not given";
}

std::string filled_in(const Cell& cell, const EffectEntry& entry, const std::vector<double>& cycles,
                      const char* sentence) {
  const std::string joints = joints_of(cell, entry);
  const bool one = entry.joints.size() == 1;
  return fmt::format(fmt::runtime(sentence), joints.empty() ? "the joints" : joints, one ? "s" : "",
                     waves_words(cycles), one ? "is" : "are", joint_name(cell, entry, 0),
                     joint_name(cell, entry, entry.joints.size() - 1),
                     fmt::format("{:.4g}", number_option(entry, OptionKey::kPitch_mm, 0.0)),
                     masses_words(cell));
}

/// Null if the law says nothing else where all its joints slide.
const AtSlide* at_slide(const Cell& cell, const EffectEntry& entry) {
  const EffectDescriptor& effect = descriptor_of(entry.name);
  return effect.at_slide != nullptr && all_slide(cell, entry) ? effect.at_slide : nullptr;
}

MovingPart part_of(const EffectEntry& step) {
  const std::string of = text_option(step, OptionKey::kOf, "tool");
  return {of == "base"    ? MotionSource::kBase
          : of == "joint" ? MotionSource::kJoint
                          : MotionSource::kTool,
          step.joints.empty() ? -1 : step.joints.front()};
}

std::string moves_words(const Cell& cell, const EffectEntry& step, const std::vector<Move>& moves) {
  std::string out = in_words(cell, part_of(step)) + " moved ";
  out += moves.size() == 2 ? "twice" : fmt::format("{} times", moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i)
    out += fmt::format("{} after row {:g} by {:.2f} mm", i == 0 ? ":" : ",", moves[i].after_row,
                       moves[i].size_m * 1e3);
  return out;
}

}  // namespace

std::string effect_sentence(const Cell& cell, const EffectEntry& entry,
                            const std::vector<double>& cycles) {
  const EffectDescriptor* effect = find_descriptor(entry.name);
  if (effect == nullptr || *effect->sentence == '\0') return in_words(cell, entry, cycles);
  const AtSlide* slide = at_slide(cell, entry);
  return filled_in(cell, entry, cycles, slide != nullptr ? slide->sentence : effect->sentence);
}

std::string effect_sentence(const Cell& cell, const Candidate& candidate) {
  if (!candidate.moves.empty()) return moves_words(cell, candidate.entry, candidate.moves);
  const EffectDescriptor* effect = find_descriptor(candidate.entry.name);
  if (effect == nullptr || !all_below_zero(candidate.numbers))
    return effect_sentence(cell, candidate.entry, candidate.cycles);
  const AtSlide* slide = at_slide(cell, candidate.entry);
  const char* negative = slide != nullptr ? slide->negative_sentence : effect->negative_sentence;
  if (negative != nullptr) return filled_in(cell, candidate.entry, candidate.cycles, negative);
  return effect_sentence(cell, candidate.entry, candidate.cycles);
}

std::string effect_sentence(const Cell& cell, const Addition& added) {
  if (!added.moves.empty()) return moves_words(cell, added.entry, added.moves);
  return effect_sentence(cell, added.entry, added.cycles);
}

}  // namespace plumb::offline

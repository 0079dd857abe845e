// SPDX-License-Identifier: Apache-2.0
#include "diagnose/alternatives.hpp"

#include <algorithm>

#include "diagnose/confounding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/excluded_laws.hpp"
#include "diagnose/gradual_motion.hpp"
#include "diagnose/unknown_weights.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

bool share_a_joint(const EffectEntry& a, const EffectEntry& b) {
  return std::any_of(a.joints.begin(), a.joints.end(), [&](int joint) {
    return std::find(b.joints.begin(), b.joints.end(), joint) != b.joints.end();
  });
}

/// Laws by which a joint turns in proportion to a load, whichever load it is.
bool yields_in_proportion(const EffectDescriptor& effect) {
  return effect.turns_listed_joint_only && grows_with_load(effect) && !effect.once_a_joint &&
         effect.joints == JointList::kSet;
}

bool lists(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool driven_by_load(const Found& found) { return grows_with_load(descriptor_of(found.entry.name)); }

/// Share of its motion that the calibrated numbers of the arm cannot imitate at these poses.
double shown(const Found& found) { return std::max(0.0, 1.0 - found.scored.absorbed); }

/// How far another cause may be behind `first` in evidence and still be the true one [nats].
/// Along a path the arm's numbers may imitate nearly all that a load does by its law, but not the
/// small part by which every law differs from nature. That part is kLawLeaves of the whole motion,
/// and the poses show as much of it as of `most_shown`, the best shown cause of this kind.
double told_nats(const WhitenedFit& whitened, const Found& first, const Found& other,
                 double most_shown) {
  if (!driven_by_load(first) || !driven_by_load(other) || !(shown(other) > 0.0)) return kTold_nats;
  const double seen_nats = 0.5 * other.scored.explained * whitened.Q;
  const double times = std::max(0.0, most_shown / shown(other) - 1.0);
  return kTold_nats + kLawLeaves * kLawLeaves * times * seen_nats;
}

/// Takes out the candidates that are too far behind `first` to be the true cause.
void drop_told(const WhitenedFit& whitened, const Found& first, std::vector<const Found*>& others) {
  double most_shown = shown(first);
  for (const Found* other : others)
    if (driven_by_load(*other)) most_shown = std::max(most_shown, shown(*other));
  std::erase_if(others, [&](const Found* other) {
    return first.ln_bayes() - other->ln_bayes() >= told_nats(whitened, first, *other, most_shown);
  });
}

/// The candidates that are another finding than `first` and not too far behind it in evidence.
std::vector<const Found*> near(const WhitenedFit& whitened, const std::vector<Found>& all,
                               const Found& first) {
  std::vector<const Found*> out;
  for (const auto& other : all)
    if (&other != &first && other.ln_bayes() > 0.0 && !one_finding(other.entry, first.entry))
      out.push_back(&other);
  drop_told(whitened, first, out);
  return out;
}

/// Those of `near` that imitate `first` as it imitates them, and so cannot be told from it.
std::vector<const Found*> cannot_be_told(const WhitenedFit& whitened, const std::vector<Found>& all,
                                         const Found& first) {
  const std::vector<const Found*> others = near(whitened, all, first);
  const std::vector<double> alike = mutual_reproduction(whitened, first, others);
  std::vector<const Found*> out;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (alike[i] >= kConfounded) out.push_back(others[i]);
  drop_told(whitened, first, out);
  return out;
}

/// Laws of the library that change with time or a temperature.
bool is_slow(const EffectEntry& entry) {
  const EffectInfo* law = descriptor_of(entry.name).law;
  return law != nullptr && (law->needs & (kNeedsTime | kNeedsTemperature)) != 0;
}

Alternative alternative(const Found& first, const Found& other) {
  Alternative out;
  out.entry = other.entry;
  out.cycles = other.cycles;
  out.domain = domain_word(other.entry);
  out.behind_nats = first.ln_bayes() - other.ln_bayes();
  out.compiled = is_compiled(other.entry);
  return out;
}

std::vector<std::string> names_of(const std::vector<Testable>& excluded) {
  std::vector<std::string> out;
  for (const auto& one : excluded) out.push_back(one.effect);
  return out;
}

/// Whether a part has moved as often as a search allows moves, or an encoder that is in the model
/// with a step slips again: so many steps describe whatever moves slowly.
bool moves_on_and_on(const WhitenedFit& whitened, const Found& step) {
  const auto& effects = whitened.cell->effects;
  return step.moves.size() >= kMostMoves ||
         std::any_of(effects.begin(), effects.end(), [&](const EffectEntry& e) {
           return is_change_point(e.name) &&
                  key_of(*whitened.cell, e) == key_of(*whitened.cell, step.entry);
         });
}

}  // namespace

bool one_finding(const EffectEntry& a, const EffectEntry& b) {
  const EffectDescriptor &x = descriptor_of(a.name), &y = descriptor_of(b.name);
  if (!share_a_joint(a, b)) return false;
  if (a.name == b.name) return true;
  return (x.cause != Cause::kItsOwn && x.cause == y.cause) ||
         (yields_in_proportion(x) && yields_in_proportion(y)) ||
         (a.joints == b.joints && (lists(x.same_motion, b.name) || lists(y.same_motion, a.name)));
}

std::vector<Alternative> alternatives_under_unknown_weights(const WhitenedFit& whitened,
                                                            const Found& first) {
  std::vector<Alternative> out;
  for (const Found& other : rivals_under_unknown_weights(whitened, first)) {
    out.push_back(alternative(first, other));
    out.back().not_shown = "no mass of a link is stated";
    out.back().measure =
        "state the masses of the links in cell.toml (mass_kg, com_mm), or measure the same poses "
        "with and without payload";
  }
  return out;
}

std::vector<Alternative> alternatives(const WhitenedFit& whitened, const Scan& look,
                                      const Found& first, const std::vector<Testable>& excluded) {
  std::vector<Alternative> out;
  for (const Found* other : cannot_be_told(whitened, look.library, first))
    out.push_back(alternative(first, *other));
  for (Alternative& other : alternatives_under_unknown_weights(whitened, first))
    out.push_back(std::move(other));
  if (excluded.empty()) return out;
  const std::vector<Found> laws = excluded_laws(whitened, names_of(excluded));
  const std::vector<const Found*> hidden = near(whitened, laws, first);
  const std::vector<double> hidden_alike = mutual_reproduction(whitened, first, hidden);
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    if (hidden_alike[i] < kConfounded && hidden[i]->score < first.score) continue;
    out.push_back(alternative(first, *hidden[i]));
    const auto why = std::find_if(excluded.begin(), excluded.end(), [&](const Testable& t) {
      return t.effect == hidden[i]->entry.name;
    });
    out.back().not_shown = why->why;
    out.back().measure = why->measure;
  }
  return out;
}

std::optional<Found> slow_motion_instead_of(const WhitenedFit& whitened, const Scan& look,
                                            const Found& first,
                                            const std::vector<Alternative>& others) {
  if (!is_change_point(first.entry.name)) return std::nullopt;
  if (auto gradual = gradual_motion_instead_of(whitened, first)) return gradual;
  const std::optional<Found>& slow = look.slow;
  if (!slow || !(slow->score > kSupported) || !slow->gain.clear) return std::nullopt;
  const bool near = slow->ln_bayes() > first.ln_bayes() - kTold_nats;
  if (!near && !moves_on_and_on(whitened, first)) return std::nullopt;
  const double lesser = std::min(slow->ln_bayes(), first.ln_bayes());
  const auto describes_it = [&](const Found& found) {
    return is_slow(found.entry) && found.score > kSupported &&
           found.ln_bayes() > lesser - kTold_nats;
  };
  const bool has_a_law =
      std::any_of(look.library.begin(), look.library.end(), describes_it) ||
      std::any_of(others.begin(), others.end(), [](const auto& o) { return is_slow(o.entry); });
  return has_a_law ? std::nullopt : slow;
}

bool names_what_is_not_shown(const std::vector<Alternative>& all) {
  return std::any_of(all.begin(), all.end(),
                     [](const Alternative& other) { return !other.not_shown.empty(); });
}

bool of_different_fate(const EffectEntry& first, const std::vector<Alternative>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Alternative& other) {
    return other.compiled != is_compiled(first);
  });
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "diagnose/forward_start.hpp"
#include "diagnose/judged_model.hpp"
#include "diagnose/refit.hpp"

namespace plumb::offline {

/// A forward selection under way: where it stands, what it has chosen, and what stays out. It owns
/// all but the measurements. Its moves have files of their own (add_effect, fresh_waves, exchange,
/// doubt_strongest, behind_oversized): each works out the next model first and then changes this
/// state, so that a refit that is refused leaves it as it stood before.
class Selection {
 public:
  /// whitened fit, look: of `calibration`.
  Selection(ForwardStart start, const Calibration& calibration, WhitenedFit whitened, Scan look);

  const ForwardStart& start() const { return start_; }
  const Cell& cell() const { return *now_.model.cell; }  // with the present effects
  const Calibration& calibration() const { return now_.model.calibration; }
  const WhitenedFit& whitened() const { return now_.whitened; }
  const Scan& look() const { return now_.look; }
  std::string key(const EffectEntry& entry) const { return key_of(cell(), entry); }

  /// Whether a candidate is small enough to be what a stronger effect's law leaves.
  bool leaves_as_remainder(const Found& found) const;

  /// Models that are only looked at; all throw as `refitted`.
  FittedModel fitted(const std::vector<EffectEntry>& effects, Refit how = Refit::kNearby) const;
  /// A nearby fit starts from what was there before; where that is refused, a full one may not be.
  FittedModel fitted_somehow(const std::vector<EffectEntry>& effects) const;
  /// The same from another calibration, whose outliers stay out.
  FittedModel fitted_from(const Calibration& from, const std::vector<EffectEntry>& effects,
                          Refit how = Refit::kNearby) const;
  WhitenedFit whitened_fit_of(const FittedModel& model) const;
  /// The present model less an effect, and what is then missing.
  JudgedModel without(const EffectEntry& entry, const std::vector<std::string>& banned) const {
    return without(std::vector<EffectEntry>{entry}, banned);
  }
  JudgedModel without(const std::vector<EffectEntry>& entries,
                      const std::vector<std::string>& banned) const;

  /// Remembers what an effect, found in the model without the one that it replaces, may be instead.
  void remember_alternatives(const JudgedModel& without, const Found& found);

  /// Stands at another model from now on. look_at: what was set aside is tried again there.
  void go_to(JudgedModel there);
  void look_at(FittedModel model, WhitenedFit whitened);
  void look_at(FittedModel model) {
    WhitenedFit whitened = whitened_fit_of(model);
    look_at(std::move(model), std::move(whitened));
  }

  /// Fits the present model once more, as what is reported is fitted (Refit::kFully); its whitened
  /// fit and scan stay as they were. Throws as `refitted`.
  void refit_fully();

  /// Keeps an effect out for good, here and later.
  void ban(const std::string& key) { banned_.push_back(key); }
  const std::vector<std::string>& banned() const { return banned_; }
  /// The scan once more, where this stands, less what is banned or set aside.
  void look_again();

  /// The model with `entry` cannot be fitted as things stand. It may be once another effect is in,
  /// so it is set aside until then, the second time for good; and it is said.
  void set_aside(const EffectEntry& entry);
  void could_be_fitted(const EffectEntry& entry) { not_judged_.erase("with " + key(entry)); }
  void not_compared_without(const EffectEntry& entry);
  void not_refitted_from_the_start();
  /// Models that could not be refitted, in words.
  std::vector<std::string> not_judged() const;

  std::vector<Found> added;                                // in the order of their choice
  std::map<std::string, std::vector<Alternative>> unsure;  // what they may be instead, by key
  std::map<std::string, int> dropped;                      // how often each was taken out, by key
  std::set<std::string> exchanged;                         // taken out once and looked for again
  std::set<std::string> sizes_doubted;                     // taken out once because of their size
  /// By key: how many effects were in the model when a step was last ranked.
  std::map<std::string, std::size_t> steps_ranked;
  bool untrimmed = false;         // the first and last poses were looked at again
  std::set<std::string> doubted;  // their rivals were followed
  std::set<std::string> renewed;  // waves that were looked for again, together
  const std::vector<FittedModel>& seen() const { return seen_; }  // the present one is the last

 private:
  ForwardStart start_;
  JudgedModel now_;
  std::vector<FittedModel> seen_;
  std::vector<std::string> banned_, waiting_;  // waiting: set aside until the model is another one
  std::map<std::string, int> failed_;
  std::map<std::string, std::string> not_judged_;  // in words, by what it is
};

}  // namespace plumb::offline

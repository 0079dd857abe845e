// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnose/forward_start.hpp"
#include "diagnose/judged_model.hpp"
#include "diagnose/proposal.hpp"
#include "diagnose/refit.hpp"

namespace plumb::offline {

/// A forward selection under way: where it stands, what it has chosen, and what stays out. It owns
/// all but the measurements. Its revisions have files of their own (exchange, doubt,
/// imitating_step, left_out_ends): each works out the next model first, which is then taken, so
/// that a refit that is refused leaves it as it stood before.
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

  /// What an effect, found in the model without the one that it replaces, may be instead.
  std::vector<Alternative> alternatives_in(const JudgedModel& without, const Found& found) const;

  /// The one way to accept what a revision proposes.
  void take(Proposal proposal);

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

  /// Takes an effect out that lost its evidence to others. A wave may be taken out twice and still
  /// be found again; any other effect stays out.
  void take_out(const EffectEntry& weak);

  /// Whether `what` was not yet done with the effect of that key, or only in another state;
  /// remembers it.
  bool first_time(const std::string& what, const std::string& key, std::size_t state = 0);
  /// With how many effects it was done.
  std::size_t times(const std::string& what) const;

  /// Effects that one of that key may be instead.
  void remember_alternatives(const std::string& key, std::vector<Alternative> others);
  std::vector<Alternative> alternatives_of(const std::string& key) const;

  /// Carries an effect from now on that must not be added, as a nuisance: it is fitted as if the
  /// cell stated it, so that it is neither added nor exchanged nor taken out. Throws as `refitted`.
  void carry(const Found& nuisance);
  const std::vector<EffectEntry>& carried() const { return carried_; }

  /// Findings between which these poses cannot decide, so that none of them is to enter the model
  /// by a revision, nor be added beside one of them that is carried.
  void leave_open(const std::vector<EffectEntry>& findings);
  const std::vector<EffectEntry>& open() const { return open_; }
  /// Whether an effect is one of these, or another law of the same finding.
  bool is_open(const EffectEntry& entry) const;

  std::vector<Found> added;                                       // in the order of their choice
  const std::vector<FittedModel>& seen() const { return seen_; }  // the present one is the last

 private:
  ForwardStart start_;
  JudgedModel now_;
  std::vector<FittedModel> seen_;
  std::vector<EffectEntry> carried_, open_;
  std::vector<std::string> banned_, waiting_;  // waiting: set aside until the model is another one
  std::map<std::string, int> failed_, taken_out_;                   // how often, by key
  std::map<std::string, std::map<std::string, std::size_t>> done_;  // states by what and key
  std::map<std::string, std::vector<Alternative>> alternatives_;    // by key
  std::map<std::string, std::string> not_judged_;                   // in words, by what it is
};

}  // namespace plumb::offline

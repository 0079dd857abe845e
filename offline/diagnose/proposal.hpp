// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/judged_model.hpp"

namespace plumb::offline {

/// A model that is to take the place of a selection's present one, and what it changes of the
/// effects that were added.
struct Proposal {
  std::variant<FittedModel, JudgedModel>
      model;                                 // judged: nothing that was set aside is tried again
  std::optional<WhitenedFit> whitened = {};  // of a fitted model, if it is known
  std::vector<EffectEntry> out = {};         // no longer added
  std::vector<Found> in = {};                // added in their place
  std::optional<std::vector<Alternative>> instead = {};  // what the first of these may be instead
  std::vector<std::string> banned = {};                  // keys of what stays out for good
};

}  // namespace plumb::offline

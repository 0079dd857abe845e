// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// One way in which a selection may change its model beside adding an effect.
struct Revision {
  const char* name;  // under which a selection remembers with what it was tried

  /// The effects with which it may be tried, in order; one without a name where it concerns none.
  std::vector<Found> (*subjects)(const Selection&);

  /// The better model, if there is one. Throws as `refitted`.
  std::optional<Proposal> (*proposal)(const Selection&, const Found& subject);

  /// Whether it is to be tried with this one now; remembers it. Null: once with each.
  bool (*due)(Selection&, const char* name, const Found& subject) = nullptr;

  /// What follows at the new model. Throws as `refitted`. Null: nothing.
  void (*afterwards)(Selection&) = nullptr;
};

/// Tries a revision with one subject after the other, until a proposal is made: the selection then
/// stands at that model, and this is true. Where a refit is refused, that is said.
bool revise(Selection& selection, const Revision& revision);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// Goes on with a selection until it ends; returns what it ended at, if that was undecided.
using SearchOn = std::function<std::optional<Undecided>(Selection&)>;

/// What is supported beside a finding that must not be added, because these poses cannot decide
/// what it is. A copy of the selection carries the wider of its alternatives as a nuisance, and the
/// search goes on in it; what is undecided there is carried too. The model that is returned is the
/// one without the nuisances, refitted: of what was found beside them it keeps what still has
/// evidence there, because that is the model which predicts, and because the held-out readings may
/// not choose. The alternatives stay open: no revision may put one of them into it.
///
/// @return  Nothing where nothing more is found and kept.
/// Cost: a search of its own.
std::optional<Selection> with_what_is_beside(const Selection& selection, const Undecided& undecided,
                                             const SearchOn& search);

}  // namespace plumb::offline

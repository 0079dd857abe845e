// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/found.hpp"

namespace plumb::offline {

/// The best of each law that a scan has left out because the data cannot show it (too few poses,
/// too small a range), joint by joint, by evidence. They are never proposed; they only show whether
/// what is proposed may be their look-alike. Laws without the columns that they need are not among
/// them.
std::vector<Found> excluded_laws(const WhitenedFit& whitened,
                                 const std::vector<std::string>& not_testable);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "fit/fit.hpp"

namespace plumb::offline {

/// `fit_cell` that says how far it is.
///
/// @param tell  Is told of every step when there are folds: "step 2 of 6, fold 1".
Fit fit_cell(const Cell& cell, const Measurements& measured,
             const std::function<void(const std::string&)>& tell);

}  // namespace plumb::offline

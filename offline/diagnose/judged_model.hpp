// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/fitted_model.hpp"
#include "diagnose/scan.hpp"
#include "diagnose/whitened_fit.hpp"

namespace plumb::offline {

/// A fitted model, what it leaves, and what the scan of that finds. The whitened fit refers to the
/// cell of this very model, which it shares, and to measurements that outlive it.
struct JudgedModel {
  FittedModel model;
  WhitenedFit whitened;
  Scan look;
};

}  // namespace plumb::offline

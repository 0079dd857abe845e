// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/scan.hpp"
#include "diagnose/whitened_fit.hpp"
#include "noise/repeatability.hpp"

namespace plumb::offline {

/// A whitened fit and what the scan of it finds.
struct JudgedFit {
  WhitenedFit whitened;
  Scan look;
  Repeatability repeatability;  // beside the best candidate, if one is supported
};

/// Scans a whitened fit. What the scan finds must hold its own against the scatter of the joints:
/// the variances are estimated once without any effect, and once beside the best candidate, and the
/// fit is then whitened by the latter and scanned again. Each candidate pays, in nats, what scatter
/// alone explains better without it than with it.
///
/// @param whitened  Of make_whitened_fit: without scatter.
JudgedFit judged(WhitenedFit whitened, const std::vector<std::string>& not_testable,
                 const std::vector<std::string>& banned);

/// How much better scatter of the joints explains the residual than noise alone [nats], at least 0.
/// Cost: as noise_and_scatter.
double scatter_nats(const WhitenedFit& whitened);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace plumb::offline {

/// A heading that says how many standard deviations its numbers are.
struct Expanded {
  double factor = 1.0;    // numbers / factor = 1 sigma
  std::string said = {};  // "U(95)", "k = 2": what says so
  std::string rest = {};  // the heading without it
};

/// "U(95) X", "U95_X", "Uncertainty X (k=2)", "U(x) [mm, k=2]", "expanded uncertainty X" and
/// "X 2 sigma" are two standard deviations, [JCGM 100:2008] 6.2; "k=3" and "3 sigma" are three.
/// Nothing if the heading does not say.
std::optional<Expanded> expanded_uncertainty(const std::string& heading);

}  // namespace plumb::offline

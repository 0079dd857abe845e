// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/regressor.hpp"
#include "plan/expected_evidence.hpp"
#include "plan/plan_steps.hpp"

namespace plumb::offline {

/// Two effects at the readings made so far and at those that could be made, as columns that
/// expected_evidence.hpp understands.
struct RivalColumns {
  Rivals rivals;
  std::optional<double> today;  // ln B of the first over the second at the readings made [nats]
  struct Number {               // of the first variant of each law
    std::string name, unit;
    double typical = 0.0;     // SI value that counts as 1
    Eigen::Index column = 0;  // of Z
  };
  std::vector<Number> numbers;
  Eigen::MatrixXd known_G, known_Z;   // whitened lines of the readings made that are fitted
  std::vector<Eigen::MatrixXd> G, Z;  // of each option, times the root of rivals.fit_share
  int parameters = 0;                 // of the model beside the two effects
  double noise_variance = 1.0;        // of a whitened line
};

/// a, b: the two effects; options: as in `with_options`. The first variant of a law is what the
/// readings so far suggest for its constants, with the sizes that they suggest, or with typical
/// sizes if they say nothing. Throws as `bind_effect`.
RivalColumns rival_columns(const Cell& cell, const PlanStart& start, const EffectEntry& a,
                           const EffectEntry& b, const std::vector<ReadingOption>& options,
                           const Circumstances& circumstances);

}  // namespace plumb::offline

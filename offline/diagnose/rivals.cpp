// SPDX-License-Identifier: Apache-2.0
#include "diagnose/rivals.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/extension.hpp"
#include "diagnose/model_parts.hpp"

namespace plumb::offline {
namespace {

Explanation followed(const WhitenedFit& from, const Found& first,
                     const std::vector<std::string>& not_testable,
                     const std::vector<std::string>& banned) {
  Explanation out{{first}, first.score};
  WhitenedFit whitened = extended(from, regressor_of(from, first), first.scored.theta);
  const double strongest = first.scored.explained * from.Q;
  const auto is_one = [&](const Found& f) {
    return f.scored.explained * whitened.Q > kRemainder * kRemainder * strongest ||
           reaches_noise(whitened, f.scored);
  };
  while (out.effects.size() < kLongestExplanation) {
    const Scan look = scan(whitened, not_testable, banned);
    const Found* next = look.supported(is_one);
    if (next == nullptr) break;
    out.effects.push_back(*next);
    out.score += next->score;
    whitened = extended(whitened, regressor_of(whitened, *next), next->scored.theta);
  }
  out.times_noise = times_noise(whitened);
  return out;
}

bool names(const Cell& cell, const Explanation& explanation, const std::string& key) {
  return std::any_of(explanation.effects.begin(), explanation.effects.end(),
                     [&](const Found& f) { return key_of(cell, f.entry) == key; });
}

}  // namespace

std::optional<Explanation> better_explanation(const WhitenedFit& whitened, const Scan& look,
                                              const std::string& chosen,
                                              const std::vector<std::string>& not_testable,
                                              const std::vector<std::string>& banned) {
  const Found* own = look.find(*whitened.cell, chosen);
  if (own == nullptr) return std::nullopt;
  const double to_beat = followed(whitened, *own, not_testable, banned).score + kAhead_nats;
  std::optional<Explanation> best;
  int tried = 0;
  for (const auto& rival : look.library) {
    if (tried == kRivalsFollowed) break;
    if (key_of(*whitened.cell, rival.entry) == chosen || rival.score <= kSupported ||
        !rival.gain.clear || rival.scored.explained < kNearlyAsMuch * own->scored.explained)
      continue;
    ++tried;
    Explanation explanation = followed(whitened, rival, not_testable, banned);
    if (explanation.times_noise > at_noise(whitened) || names(*whitened.cell, explanation, chosen))
      continue;
    if (explanation.score > (best ? best->score : to_beat)) best = std::move(explanation);
  }
  return best;
}

}  // namespace plumb::offline

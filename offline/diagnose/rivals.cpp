// SPDX-License-Identifier: Apache-2.0
#include "diagnose/rivals.hpp"

#include <algorithm>

#include "diagnose/extension.hpp"
#include "diagnose/model_parts.hpp"

namespace plumb::offline {
namespace {

constexpr int kLongest = 3;      // effects of an explanation
constexpr int kRivals = 5;       // besides the chosen one
constexpr double kNearly = 0.5;  // of what the chosen one explains

Explanation followed(const Stage& from, const Found& first,
                     const std::vector<std::string>& not_testable,
                     const std::vector<std::string>& banned) {
  Explanation out{{first}, first.score};
  Stage stage = extended(from, block_of(from, first));
  const double strongest = first.trial.explained * from.Q;
  const auto is_one = [&](const Found& f) {
    return f.trial.explained * stage.Q > kRemainder * kRemainder * strongest ||
           reaches_noise(stage, f.trial);
  };
  while (out.effects.size() < kLongest) {
    const Scan look = scan(stage, not_testable, banned);
    const Found* next = look.supported(is_one);
    if (next == nullptr) break;
    out.effects.push_back(*next);
    out.score += next->score;
    stage = extended(stage, block_of(stage, *next));
  }
  out.times_noise = times_noise(stage);
  return out;
}

bool names(const Cell& cell, const Explanation& explanation, const std::string& key) {
  return std::any_of(explanation.effects.begin(), explanation.effects.end(),
                     [&](const Found& f) { return key_of(cell, f.entry) == key; });
}

}  // namespace

std::optional<Explanation> better_explanation(const Stage& stage, const Scan& look,
                                              const std::string& chosen,
                                              const std::vector<std::string>& not_testable,
                                              const std::vector<std::string>& banned) {
  const Found* own = look.find(*stage.cell, chosen);
  if (own == nullptr) return std::nullopt;
  const double to_beat = followed(stage, *own, not_testable, banned).score + kAhead_nats;
  std::optional<Explanation> best;
  int tried = 0;
  for (const auto& rival : look.library) {
    if (tried == kRivals) break;
    if (key_of(*stage.cell, rival.entry) == chosen || rival.score <= kSupported ||
        !rival.gain.clear || rival.trial.explained < kNearly * own->trial.explained)
      continue;
    ++tried;
    Explanation explanation = followed(stage, rival, not_testable, banned);
    if (explanation.times_noise > at_noise(stage) || names(*stage.cell, explanation, chosen))
      continue;
    if (explanation.score > (best ? best->score : to_beat)) best = std::move(explanation);
  }
  return best;
}

}  // namespace plumb::offline

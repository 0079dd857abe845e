// SPDX-License-Identifier: Apache-2.0
#include "diagnose/found_series.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "diagnose/constants.hpp"
#include "diagnose/series_scan.hpp"
#include "effects/registry.hpp"
#include "fit/effect_binding.hpp"
#include "fit/series_numbers.hpp"

namespace plumb::offline {
namespace {

/// At every joint with an uneven gear the law of this joint alone that says most.
std::map<int, const Found*> best_at_joints(const std::vector<Found>& library) {
  std::map<int, const Found*> best;
  std::set<int> uneven;
  for (const auto& found : library) {
    if (found.entry.joints.size() != 1 || !(found.score > kSupported)) continue;
    const int joint = found.entry.joints.front();
    if (descriptor_of(found.entry.name).cause == Cause::kUnevenGear) uneven.insert(joint);
    const Found*& at_joint = best[joint];
    if (at_joint == nullptr || found.score > at_joint->score) at_joint = &found;
  }
  std::erase_if(best, [&](const auto& at) { return !uneven.contains(at.first); });
  return best;
}

/// The largest waves in words.
std::string peaks_of(const WhitenedFit& s, const Found& found) {
  const Regressor series = series_regressor(s, found.entry);
  format::Model model;
  model.calibrated = s.cell->nominal;
  model.effects = {bind_effect(*s.cell, *s.measured, found.entry)};
  for (Eigen::Index c = 0; c < found.scored.theta.size(); ++c)
    model.effects[0].parameters[static_cast<std::size_t>(c)] =
        found.scored.theta(c) * series.typical(c);
  return series_words(*s.cell, model);
}

/// One series at these joints.
std::optional<Found> series_at(const Scorer& scorer, SeriesSums& sums,
                               const std::vector<int>& joints, double paid) {
  auto series = scan_series(scorer, sums, joints);
  if (!series) return std::nullopt;
  Found out{series->entry, {}, std::move(series->scored), {}, 0.0, {}, 0.0};
  out.score = out.ln_bayes() - paid;
  return out;
}

/// Whether a series of waves takes the place of what says most about its joint. Several single
/// waves make way for it as soon as it is ahead; a law that says it in fewer numbers keeps its name
/// unless the series also explains clearly more.
bool takes_the_place(const Found& series, const Found& best) {
  if (series.score < best.score + kAhead_nats) return false;
  return best.cycles.size() >= kFewestForSeries ||
         series.scored.explained > best.scored.explained + kAhead_share;
}

}  // namespace

bool has_series_at(const WhitenedFit& whitened, int joint) {
  return std::any_of(
      whitened.cell->effects.begin(), whitened.cell->effects.end(), [&](const EffectEntry& e) {
        return is_series(e.name) && (e.joints.empty() || std::find(e.joints.begin(), e.joints.end(),
                                                                   joint) != e.joints.end());
      });
}

std::optional<Found> find_series(const Scorer& scorer, const std::vector<Found>& library,
                                 double paid) {
  const WhitenedFit& s = scorer.whitened();
  SeriesSums sums(s, kSeriesWaves);
  std::vector<int> joints;
  std::optional<Found> out;
  for (const auto& [joint, best] : best_at_joints(library)) {
    if (!s.chain.revolute(joint) || has_series_at(s, joint)) continue;
    auto alone = series_at(scorer, sums, {joint}, paid);
    if (!alone || !takes_the_place(*alone, *best)) continue;
    joints.push_back(joint);
    out = std::move(alone);
  }
  if (joints.size() > 1) out = series_at(scorer, sums, joints, paid);
  if (out) out->peaks = peaks_of(s, *out);
  return out;
}

}  // namespace plumb::offline

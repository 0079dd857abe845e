// SPDX-License-Identifier: Apache-2.0
#include "diagnose/series_of_all.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/constants.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/judged_fit.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/rms_reduction.hpp"
#include "diagnose/series_scan.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// The joints that turn and have no series yet.
std::vector<int> joints_to_ask(const WhitenedFit& s) {
  std::vector<int> out;
  for (int j = 0; j < s.joints(); ++j)
    if (s.chain.revolute(j) && !has_series_at(s.cell->effects, j)) out.push_back(j);
  return out;
}

bool can_be_shown(const std::vector<std::string>& not_testable) {
  return std::find(not_testable.begin(), not_testable.end(), series_effect()) == not_testable.end();
}

/// One subject: the revision concerns none of the effects.
std::vector<Found> once(const Selection& s) {
  if (!can_be_shown(s.start().not_testable) || s.cell().effects.size() >= kMostEffects) return {};
  return {Found{}};
}

bool due_series(Selection& s, const char* name, const Found&) {
  return s.first_time(name, "", s.added.size());
}

std::optional<Proposal> model_with_series(const Selection& s, const Found&) {
  auto found = series_of_all(s.whitened(), s.calibration(), s.look());
  if (!found ||
      std::find(s.banned().begin(), s.banned().end(), s.key(found->entry)) != s.banned().end())
    return std::nullopt;
  const ForwardStart& start = s.start();
  FittedModel next = s.fitted_somehow(with_found(s.cell().effects, *found));
  if (rms_reduction(start.cell, start.measured, start.fit, s.calibration(), next.calibration) <
      kRealShare)
    return std::nullopt;
  return Proposal{.model = std::move(next), .in = {std::move(*found)}};
}

}  // namespace

std::optional<Found> series_of_all(const WhitenedFit& whitened, const Calibration& calibration,
                                   const Scan& look) {
  const Scorer scorer(whitened);
  const double paid = std::log(std::max(1.0, look.regressors));
  auto series = scan_series_of_all(scorer, joints_to_ask(whitened), paid);
  if (!series) return std::nullopt;
  Found out{series->entry, {}, std::move(series->scored), {}, 0.0, {}, 0.0};
  // Hundreds of waves imitate the scatter of the joints, which looks the same at poses far from
  // each other. A scan that has found no candidate was not asked what that explains.
  out.scored.evidence.ln_bayes -= std::max(0.0, scatter_nats(whitened) - whitened.scatter_nats);
  out.score = out.ln_bayes() - paid;
  if (!(out.score > kSupported) || is_remainder(*whitened.cell, whitened, calibration, out))
    return std::nullopt;
  out.gain = scorer.gain(out.scored);
  if (!out.gain.clear) return std::nullopt;
  out.sizes = sizes_of(whitened, out.entry, out.scored);
  out.peaks = out.sizes + "; " + peaks_of(whitened, out.entry, out.scored);
  return out;
}

void add_series_of_all(const WhitenedFit& whitened, const Calibration& calibration,
                       const std::vector<std::string>& not_testable, Scan& look) {
  const auto is_one = [&](const Found& f) {
    return !is_remainder(*whitened.cell, whitened, calibration, f);
  };
  if (!can_be_shown(not_testable) || look.unknown() || look.supported(is_one) != nullptr) return;
  auto found = series_of_all(whitened, calibration, look);
  if (!found) return;
  const auto after = std::find_if(look.library.begin(), look.library.end(),
                                  [&](const Found& f) { return f.ln_bayes() < found->ln_bayes(); });
  look.library.insert(after, std::move(*found));
}

const Revision kSeriesOfAll{
    .name = "series of all", .subjects = once, .proposal = model_with_series, .due = due_series};

}  // namespace plumb::offline

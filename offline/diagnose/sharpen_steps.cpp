// SPDX-License-Identifier: Apache-2.0
#include "diagnose/sharpen_steps.hpp"

#include "diagnose/change_points.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/refit.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// How far a cut may move from where it was found, in gaps between the readings used for selection.
constexpr Eigen::Index kGapsAway = 5;

std::vector<double> places_of(const ForwardStep& step) {
  std::vector<double> out;
  for (const Move& move : step.moves) out.push_back(move.after_row);
  if (out.empty()) out.push_back(number_option(step.entry, OptionKey::kAfterRow, 0.0));
  return out;
}

EffectEntry at(EffectEntry step, double after_row) {
  set_option(step, OptionKey::kAfterRow, after_row);
  return step;
}

void sharpen_one(const Cell& cell, const Measurements& measured, const StepReadings& rows,
                 const Calibration& from, ForwardStep& step, std::vector<EffectEntry>& effects) {
  Cell without = cell;
  without.effects = effects;
  ChangePoint point{step.entry, places_of(step)};
  for (const double row : point.after_rows)
    without.effects = without_effect(without.effects, at(step.entry, row));
  const Calibration fitted =
      refitted(cell, measured, rows.choosing, without.effects, from, Refit::kNearby);
  const WhitenedFit whitened =
      make_whitened_fit(without, measured, fitted, without_outliers(rows.all, fitted.outliers), {});
  sharpen(whitened, kGapsAway * static_cast<Eigen::Index>(rows.all.size() / rows.choosing.size()),
          point);
  step.entry = point.entry;
  for (std::size_t i = 0; i < step.moves.size(); ++i) step.moves[i].after_row = point.after_rows[i];
  for (const double row : point.after_rows)
    without.effects = with_effect(without.effects, at(step.entry, row));
  effects = std::move(without.effects);
}

}  // namespace

void sharpen_steps(const Cell& cell, const Measurements& measured, const StepReadings& rows,
                   std::vector<ForwardStep>& steps) {
  ForwardStep& last = steps.back();
  for (ForwardStep& step : steps)
    if (is_change_point(step.entry.name))
      unless_refused(
          [&] { sharpen_one(cell, measured, rows, last.calibration, step, last.effects); });
}

}  // namespace plumb::offline

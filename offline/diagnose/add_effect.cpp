// SPDX-License-Identifier: Apache-2.0
#include "diagnose/add_effect.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/rms_reduction.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// A series takes the place of what the selection itself has found of uneven gears at its joints.
void forget_what_it_covers(Selection& s, const Found& found) {
  for (const int joint : found.entry.joints)
    std::erase_if(s.added, [&](const Found& old) {
      return descriptor_of(old.entry.name).cause == Cause::kUnevenGear &&
             old.entry.joints == std::vector<int>{joint};
    });
}

std::vector<EffectEntry> without_what_it_covers(const Selection& s, const Found& found) {
  std::vector<EffectEntry> out = s.cell().effects;
  if (!is_series(found.entry.name)) return out;
  std::erase_if(out, [&](const EffectEntry& old) {
    return descriptor_of(old.name).cause == Cause::kUnevenGear && old.joints.size() == 1 &&
           !has_effect(s.start().cell.effects, old) &&
           std::find(found.entry.joints.begin(), found.entry.joints.end(), old.joints.front()) !=
               found.entry.joints.end();
  });
  return out;
}

void add_if_it_fits(Selection& s, const Found& found) {
  const ForwardStart& start = s.start();
  FittedModel next = s.fitted_somehow(with_found(without_what_it_covers(s, found), found));
  s.could_be_fitted(found.entry);
  if (rms_reduction(start.cell, start.measured, start.fit, s.calibration(), next.calibration) <
      kRealShare) {
    s.ban(s.key(found.entry));
    s.look_again();
    return;
  }
  WhitenedFit whitened = s.whitened_fit_of(next);
  const auto weak = lost(*next.cell, whitened, next.calibration, start.cell.effects, found.entry);
  if (weak) {
    next = s.fitted_somehow(without_effect(next.cell->effects, *weak));
    whitened = s.whitened_fit_of(next);
  }
  if (is_series(found.entry.name)) forget_what_it_covers(s, found);
  s.added.push_back(found);
  if (weak) s.take_out(*weak);
  s.look_at(std::move(next), std::move(whitened));
}

}  // namespace

void add_effect(Selection& s, const Found& found) {
  if (s.start().tell) s.start().tell(s.key(found.entry));
  if (!unless_refused([&] { add_if_it_fits(s, found); })) s.set_aside(found.entry);
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/left_beside.hpp"

#include <algorithm>

#include "cell/effects_edit.hpp"

namespace plumb::offline {
namespace {

double squared(double x) { return x * x; }

/// Whether something is left that no effect explains, far above the noise or of a known shape.
bool something_is_left(const Diagnosis& d) {
  return d.unknown_after.has_value() || (d.held_out_excess && d.held_out_excess->lack_of_fit());
}

bool at_the_joint_of_the_rest(const Diagnosis& d, const EffectEntry& entry) {
  if (!d.unknown_after || d.unknown_after->pattern.slow) return false;
  return std::find(entry.joints.begin(), entry.joints.end(), d.unknown_after->pattern.joint) !=
         entry.joints.end();
}

}  // namespace

PartOf part_of(const Diagnosis& d, const Addition& added) {
  if (!something_is_left(d)) return PartOf::kNothing;
  if (at_the_joint_of_the_rest(d, added.entry)) return PartOf::kRestOfItsJoint;
  const double left = squared(d.after.rms) - squared(d.floor.rms_m);
  double before = d.before.rms;
  for (const Addition& one : d.added) {
    if (&one == &added) break;
    before = one.held.rms;
  }
  return squared(before) - squared(added.held.rms) < left ? PartOf::kLargerRest : PartOf::kNothing;
}

PartOf part_of_first(const Diagnosis& d) {
  if (d.candidates.empty()) return PartOf::kNothing;
  const auto found = std::find_if(d.added.begin(), d.added.end(), [&](const Addition& added) {
    return same_effect(added.entry, d.candidates.front().entry);
  });
  return found == d.added.end() ? PartOf::kNothing : part_of(d, *found);
}

}  // namespace plumb::offline

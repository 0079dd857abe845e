// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "diagnose/effect_list.hpp"
#include "diagnose/revision.hpp"
#include "diagnose/selection.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {

inline std::vector<int> all_rows(const BlindCase& blind) {
  std::vector<int> out(static_cast<std::size_t>(blind.measured.measured.size()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// A selection that begins with the effects of this cell, at the measurements of the case. It owns
/// all but these.
inline Selection begun(const BlindCase& blind, const Cell& cell) {
  const Measurements& m = blind.measured.measured;
  const std::vector<int> rows = all_rows(blind);
  const Calibration base = calibrate(cell, m, rows);
  const WhitenedFit whitened =
      make_whitened_fit(cell, m, base, without_outliers(rows, base.outliers), {});
  return Selection({cell, m, rows, {}, {}}, base, whitened, scan(whitened, {}, {}));
}
inline Selection begun(const BlindCase& blind) { return begun(blind, blind.cell); }

/// A selection that has added these effects, rightly or not, to those that the cell states.
inline Selection having_added(const BlindCase& blind, const std::vector<EffectEntry>& effects) {
  Selection s = begun(blind);
  for (const EffectEntry& entry : effects) {
    s.added.emplace_back().entry = entry;
    std::vector<EffectEntry> all = s.cell().effects;
    all.push_back(entry);
    s.look_at(s.fitted(all));
  }
  return s;
}

/// The keys of an effect, one for each of its joints.
inline std::vector<std::string> keys_of(const Selection& s, const EffectEntry& entry) {
  std::vector<std::string> out;
  EffectEntry one = entry;
  for (const int joint : entry.joints) {
    one.joints = {joint};
    out.push_back(s.key(one));
  }
  if (entry.joints.empty()) out.push_back(s.key(entry));
  return out;
}

/// Those of the effects that a model has beside those that the cell states, sorted.
inline std::vector<std::string> keys_in(const Selection& s) {
  std::vector<std::string> out;
  for (const EffectEntry& entry : s.cell().effects)
    if (!has_effect(s.start().cell.effects, entry))
      for (const std::string& key : keys_of(s, entry)) out.push_back(key);
  std::sort(out.begin(), out.end());
  return out;
}
/// The same of those that the selection says it has added.
inline std::vector<std::string> keys_added(const Selection& s) {
  std::vector<std::string> out;
  for (const Found& found : s.added)
    for (const EffectEntry& entry : found.entries())
      for (const std::string& key : keys_of(s, entry)) out.push_back(key);
  std::sort(out.begin(), out.end());
  return out;
}

/// A healthy arm of so many poses.
inline BlindCase healthy_arm(int poses, std::uint64_t seed = 1) {
  BlindRequest request;
  request.poses = poses;
  request.fresh_poses = 1;
  request.repeats = 1;
  request.seed = seed;
  return make_blind_case(request);
}

/// The gear of a joint is eccentric by so much [rad]: exactly what the law gear_harmonics says.
inline void make_uneven(BlindCase& blind, Eigen::Index joint, double size) {
  auto q = blind.measured.measured.q.col(joint);
  const Eigen::VectorXd here = q;
  q.array() -= size * ((here.array() + 0.7).sin() + 0.5 * (2.0 * here.array()).cos());
}

}  // namespace plumb::offline

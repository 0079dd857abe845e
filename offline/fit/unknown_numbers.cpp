// SPDX-License-Identifier: Apache-2.0
#include "fit/unknown_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/earlier_arm.hpp"
#include "fit/constants.hpp"
#include "program/counted_words.hpp"
#include "solve/imagined_poses.hpp"

namespace plumb::offline {
namespace {

constexpr Identifiability kToldApart{.min_independent_share = kIndependence};

bool knows(const EarlierArm& earlier, const Parameter& p) {
  return std::any_of(earlier.numbers.begin(), earlier.numbers.end(),
                     [&](const auto& n) { return n.name == p.name; });
}

}  // namespace

UnknownNumbers unknown_numbers(const EarlierArm& earlier, const Cell& cell, const FitData& data,
                               const ArmState& placed, const std::vector<Parameter>& candidates) {
  UnknownNumbers out;
  std::vector<Parameter> order, others, effects;
  for (const auto& p : candidates)
    if (!p.of_robot()) order.push_back(p);
  for (const auto& p : candidates) {
    if (!p.of_robot()) continue;
    (p.of_effect() ? effects : knows(earlier, p) ? order : others).push_back(p);
  }
  order.insert(order.end(), others.begin(), others.end());
  const ColumnSubset subset =
      identifiable(at_imagined_poses(cell, data, placed, order), kToldApart);
  std::vector<bool> kept(order.size(), false);
  for (const int k : subset.kept) kept[static_cast<std::size_t>(k)] = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Parameter& p = order[k];
    if (!p.of_robot() && kept[k]) out.placing.push_back(p.name);
    if (p.of_robot() && !kept[k] && !knows(earlier, p))
      out.redundant.push_back(p.name);
    else
      out.candidates.push_back(p);
  }
  out.candidates.insert(out.candidates.end(), effects.begin(), effects.end());
  return out;
}

void check_placed_by_poses(const FitData& data, const UnknownNumbers& unknown,
                           const std::vector<std::string>& held) {
  std::vector<std::string> open;
  for (const auto& name : unknown.placing)
    if (std::find(held.begin(), held.end(), name) != held.end()) open.push_back(name);
  if (open.empty()) return;
  throw Failure(Exit::kNumbersSayNo,
                {.code = "E-FIT-FEW",
                 .message = fmt::format("{} not show where tracker and reflector are: {}",
                                        counted_words(static_cast<long long>(data.rows.size()),
                                                      "reading does", "readings do"),
                                        fmt::join(open, ", ")),
                 .help = "measure at least 8 different poses: plumb plan --n 12"});
}

}  // namespace plumb::offline

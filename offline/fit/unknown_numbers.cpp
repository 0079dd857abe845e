// SPDX-License-Identifier: Apache-2.0
#include "fit/unknown_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "arm/arm_change.hpp"
#include "cell/earlier_arm.hpp"
#include "fit/constants.hpp"
#include "program/counted_words.hpp"
#include "program/file.hpp"
#include "solve/imagined_poses.hpp"

namespace plumb::offline {
namespace {

constexpr Identifiability kToldApart{.min_independent_share = kIndependence};

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool knows(const EarlierArm& earlier, const Parameter& p) {
  return std::any_of(earlier.numbers.begin(), earlier.numbers.end(),
                     [&](const auto& n) { return n.name == p.name; });
}

std::size_t different_poses(const FitData& data) {
  std::set<int> poses;
  for (const int row : data.rows)
    poses.insert(data.measured->replicate_group[static_cast<std::size_t>(row)]);
  return poses.size();
}

double value_in(const EarlierArm& earlier, const Parameter& p) {
  return earlier.target_T[static_cast<std::size_t>(p.component)];
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

std::vector<Parameter> reflector_left_open(const FitData& data, const UnknownNumbers& unknown,
                                           const std::vector<std::string>& held) {
  std::vector<Parameter> out;
  if (different_poses(data) < kFewestPlacing) return out;
  for (const auto& p : unknown.candidates)
    if (p.kind == Parameter::Kind::kTarget && is_among(p.name, unknown.placing) &&
        is_among(p.name, held))
      out.push_back(p);
  return out;
}

ArmState with_reflector_of(const EarlierArm& earlier, const ArmState& state,
                           const std::vector<Parameter>& open) {
  Eigen::VectorXd change(static_cast<Eigen::Index>(open.size()));
  for (std::size_t i = 0; i < open.size(); ++i)
    change(static_cast<Eigen::Index>(i)) = value_in(earlier, open[i]) - value_of(state, open[i]);
  return moved(state, open, change);
}

Problem reflector_as_earlier(const EarlierArm& earlier, const std::vector<Parameter>& open) {
  std::vector<std::string> held;
  for (const auto& p : open)
    held.push_back(fmt::format("{} at {:.3f} mm", p.name, value_in(earlier, p) * 1e3));
  return {.severity = Severity::kNote,
          .code = "N-FIT-REFLECTOR",
          .message = fmt::format("these poses do not tell where the reflector sits on the tool; "
                                 "held as in {}: {}",
                                 display_name(earlier.run), fmt::join(held, ", ")),
          .help = "to know it, measure poses that lean the tool: plumb plan --n 12"};
}

void check_placed_by_poses(const FitData& data, const UnknownNumbers& unknown,
                           const std::vector<std::string>& held) {
  std::set<int> seen;
  for (const int row : data.rows) seen.insert(setup_of(*data.measured, row));
  // Of an artefact that is held out no row is fitted, and its own rows tell where it is.
  const auto held_out = [&](const std::string& name) {
    return std::any_of(unknown.candidates.begin(), unknown.candidates.end(), [&](const auto& p) {
      return p.name == name && !seen.contains(p.setup) && p.of_base() &&
             p.kind != Parameter::Kind::kFrame;
    });
  };
  std::vector<std::string> open;
  for (const auto& name : unknown.placing)
    if (is_among(name, held) && !held_out(name)) open.push_back(name);
  if (open.empty()) return;
  throw Failure(Exit::kNumbersSayNo,
                {.code = "E-FIT-FEW",
                 .message = fmt::format("{} not show where tracker and reflector are: {}",
                                        counted_words(static_cast<long long>(data.rows.size()),
                                                      "reading does", "readings do"),
                                        fmt::join(open, ", ")),
                 .help = fmt::format("measure at least {} different poses: plumb plan --n 12",
                                     kFewestPlacing)});
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "check/check.hpp"
#include "effects/registry.hpp"
#include "fit/orientation_words.hpp"
#include "noise/main_jump.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

int count(const Check& check, Severity severity) {
  return static_cast<int>(
      std::count_if(check.findings.begin(), check.findings.end(),
                    [&](const Problem& problem) { return problem.severity == severity; }));
}

}  // namespace

bool can_be_fixed(const Check& check) {
  return check.detection.changed || !check.orientations.edit.empty();
}

Usability usability(const Check& check) {
  if (check.detection.changed || check.orientations.stops()) return Usability::kNotAsLabelled;
  if (check.exit != Exit::kDone) return Usability::kNothing;
  if (!check.moved.empty()) return Usability::kWithEffect;
  return check.orientations.judged.fit_to_use() ? Usability::kAll : Usability::kPositions;
}

std::string verdict(const Check& check) {
  const Usability usable = usability(check);
  const int warnings = count(check, Severity::kWarning);
  if (usable == Usability::kNotAsLabelled) {
    std::vector<std::string> wrong = check.changes;
    if (check.orientations.stops())
      wrong.push_back(in_words(check.orientations.judged, check.orientations.meant));
    return fmt::format("Not usable as labelled: {} (plumb check --fix puts it right).",
                       fmt::join(wrong, "; "));
  }
  if (usable == Usability::kNothing)
    return fmt::format("Not usable: {}.", check.findings.front().message);
  const int poses = check.coverage ? check.coverage->poses : 0;
  const int rank = check.parameters ? check.parameters->rank : 0;
  const bool has_effects =
      check.parameters && !check.parameters->calibration.state.arm.effects.empty();
  const std::string fit =
      check.detection.why_not.empty()
          ? fmt::format("fit the labels to {:.3g} mm{} and", check.detection.best.fitted_m * 1e3,
                        has_effects ? " with geometry alone" : "")
          : "cannot show whether the labels are right, but";
  const std::string numbers = fmt::format(
      "the {} {} tell {} of arm, frame and target{}.", counted_words(poses, "pose", "poses"), fit,
      counted_words(rank, "number", "numbers"),
      warnings == 0 ? "" : ", with " + counted_words(warnings, "warning", "warnings"));
  if (usable == Usability::kPositions)
    return fmt::format("Usable for positions alone: {}. Without the orientations {}",
                       in_words(check.orientations.judged, check.orientations.meant), numbers);
  if (usable == Usability::kAll) return "Usable: " + numbers;
  return fmt::format("Usable only with the effect '{}', because {}. Without that effect {}",
                     change_point_effect(), check.moved, numbers);
}

}  // namespace plumb::offline

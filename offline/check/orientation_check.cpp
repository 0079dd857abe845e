// SPDX-License-Identifier: Apache-2.0
#include "check/orientation_check.hpp"

#include <fmt/format.h>

#include "check/orientation_interpretations.hpp"
#include "fit/orientation_words.hpp"

namespace plumb::offline {

OrientationCheck check_orientations(const Cell& cell, const MeasurementFiles& measured) {
  OrientationCheck out;
  if (!measured.has_orientation()) return out;
  const std::vector<int> rows = rows_to_judge(measured);
  const auto named = orientation_interpretations(measured, rows);
  std::vector<OrientationInterpretation> others;
  for (const auto& one : named) others.push_back(one.interpretation);
  const Measurements& all = measured;
  out.judged = judge_orientations(cell, pick(all, rows), others);
  if (out.judged.kind != MeasuredOrientations::Kind::kOtherwise) return out;
  for (const int k : out.judged.interpretations)
    out.meant.push_back(named[static_cast<std::size_t>(k)].words);
  if (out.meant.size() == 1)
    out.edit = named[static_cast<std::size_t>(out.judged.interpretations.front())].edit;
  return out;
}

std::optional<Problem> orientation_finding(const OrientationCheck& check) {
  const std::string words = in_words(check.judged, check.meant);
  if (words.empty()) return std::nullopt;
  Problem out{.severity = Severity::kWarning,
              .code = "W-CHECK-ORIENTATION",
              .message = words,
              .help = remedy(check.judged)};
  if (check.judged.kind == MeasuredOrientations::Kind::kOtherwise) {
    out.message += fmt::format("; read so they scatter by {} urad per axis about the fitted arm",
                               sigma_urad_to_state(check.judged));
    out.help = check.edit.empty() ? "find out which it is, and convert them to qw, qx, qy, qz"
                                  : "plumb check --fix";
  }
  if (check.stops()) {
    out.severity = Severity::kError;
    out.code = "E-CHECK-ORIENTATION";
  }
  return out;
}

}  // namespace plumb::offline

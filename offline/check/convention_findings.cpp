// SPDX-License-Identifier: Apache-2.0
#include "check/convention_findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cell/setups.hpp"
#include "check/constants.hpp"

namespace plumb::offline {

std::vector<Problem> convention_findings(const Cell& cell, const Detection& d) {
  if (!d.why_not.empty())
    return {{Severity::kNote, "N-CHECK-CONVENTION", "conventions were not checked: " + d.why_not,
             std::nullopt, d.help}};
  const Convention& labels = d.present.convention;
  if (d.changed)
    return {{Severity::kError, "E-CHECK-CONVENTION",
             fmt::format("{}: that leaves {:.3g} mm, as labelled it is {:.4g} mm",
                         fmt::join(in_words(cell, labels, d.best.convention), "; "),
                         d.best.fitted_m * 1e3, d.present.fitted_m * 1e3),
             std::nullopt, "plumb check --fix"}};
  std::vector<Problem> out;
  for (const auto& other : d.same)
    if (other.changes < check::kOneChange)
      out.push_back({Severity::kNote, "N-CHECK-UNDECIDED",
                     fmt::format("these points cannot tell whether {}",
                                 fmt::join(in_words(cell, labels, other.convention), "; ")),
                     std::nullopt,
                     "mount the reflector further from the axis, or trust the label"});
  return out;
}

std::vector<Problem> other_setup_findings(const Cell& cell, const MeasurementFiles& measured) {
  std::vector<Problem> out;
  if (measured.setup.empty()) return out;
  const int seen = largest_setup(cell, measured);
  for (int k = 0; k < setup_count(cell.measurement); ++k) {
    if (k == seen) continue;
    const OneSetup one = one_setup(cell, measured, k);
    const Detection found = detect_convention(one.cell, one.measured);
    if (!found.why_not.empty() || !found.changed) continue;
    const auto words = in_words(one.cell, found.present.convention, found.best.convention);
    out.push_back(
        {Severity::kError, "E-CHECK-CONVENTION",
         fmt::format("set-up '{}': {}: that leaves {:.3g} mm, as labelled it is {:.4g} mm",
                     setup_name(cell.measurement, k), fmt::join(words, "; "),
                     found.best.fitted_m * 1e3, found.present.fitted_m * 1e3),
         std::nullopt, "the other set-ups fit as labelled: put the files of this one right"});
  }
  return out;
}

}  // namespace plumb::offline

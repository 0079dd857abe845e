// SPDX-License-Identifier: Apache-2.0
#include "diagnose/left_out_ends.hpp"

#include <algorithm>
#include <set>

#include "diagnose/constants.hpp"
#include "diagnose/found_list.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr double kMostly = 0.8;  // share of a run of poses: left out before, explained now

/// Length of the longest run at the beginning of `rows` that was mostly left out; 0 if it is short.
std::size_t run_left_out(const std::vector<int>& rows, const std::set<int>& out) {
  std::size_t best = 0, count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    count += out.contains(rows[i]) ? 1 : 0;
    const auto length = static_cast<double>(i + 1);
    if (out.contains(rows[i]) && static_cast<double>(count) >= kMostly * length) best = i + 1;
  }
  return best < static_cast<std::size_t>(kFewestBesideStep) ? 0 : best;
}

/// The calibration with the ends of the series no longer left out; unchanged if they were not.
Calibration with_ends(const Selection& s) {
  Calibration out = s.calibration();
  std::set<int> left_out;
  for (const auto& outlier : out.outliers) left_out.insert(static_cast<int>(outlier.row));
  std::vector<int> rows = s.start().fit;
  std::sort(rows.begin(), rows.end());
  std::set<int> back;
  for (int end = 0; end < 2; ++end) {
    const std::size_t run = run_left_out(rows, left_out);
    back.insert(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(run));
    std::reverse(rows.begin(), rows.end());
  }
  std::erase_if(out.outliers, [&](const Outlier& outlier) {
    return back.contains(static_cast<int>(outlier.row));
  });
  return out;
}

std::optional<Proposal> with_step_at_ends(const Selection& s, const Found&) {
  const Calibration ends = with_ends(s);
  if (ends.outliers.size() == s.calibration().outliers.size()) return std::nullopt;
  const WhitenedFit whitened = make_whitened_fit(
      s.cell(), s.start().measured, ends, without_outliers(s.start().fit, ends.outliers), {});
  const Scan look = scan(whitened, s.start().not_testable, s.banned());
  const Found* step = look.supported([](const Found& f) { return is_change_point(f.entry.name); });
  if (step == nullptr || s.is_open(step->entry)) return std::nullopt;
  FittedModel next = s.fitted_from(ends, with_found(s.cell().effects, *step));
  // A step that leaves them outliers does not explain them. Its numbers alone fit two poses.
  const auto number = [](const Calibration& c) { return static_cast<double>(c.outliers.size()); };
  const double put_back = number(s.calibration()) - number(ends);
  const double out_again = number(next.calibration) - number(ends);
  if (out_again > (1.0 - kMostly) * put_back) return std::nullopt;
  return Proposal{.model = std::move(next), .in = {*step}};
}

}  // namespace

const Revision kLeftOutEnds{.name = "left-out ends",
                            .subjects = [](const Selection&) { return std::vector<Found>(1); },
                            .proposal = with_step_at_ends};

}  // namespace plumb::offline

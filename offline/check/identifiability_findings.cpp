// SPDX-License-Identifier: Apache-2.0
#include "check/identifiability_findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "cell/earlier_arm.hpp"
#include "check/constants.hpp"
#include "effects/registry.hpp"
#include "fit/few_poses.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

/// More warnings than these are told in a single sentence.
constexpr std::size_t kMostSentences = 4;

/// How many numbers one measurement gives: its measured coordinates, and three for an orientation.
std::size_t coordinates_of_each(const Cell& cell, const Measurements& measured) {
  std::size_t out = measured.has_orientation() && cell.measurement.sigma_rad ? 3 : 0;
  for (const bool has : measured.has_axis) out += has ? 1 : 0;
  return out;
}

/// How many of `numbers` unknowns are not known from an earlier run. The six of the frame never
/// are.
int not_known_before(const Cell& cell, int numbers) {
  if (!cell.fit.earlier) return numbers;
  const int known = static_cast<int>(cell.fit.earlier->numbers.size());
  return std::max(std::min(numbers, check::kFrameNumbers), numbers - known);
}

}  // namespace

std::vector<Problem> separation_findings(const IdentifiabilityReport& report) {
  std::vector<std::string> names, texts;
  for (const auto& s : report.separations)
    if (s.cause == Separation::Cause::kPoses) {
      names.push_back(s.parameter);
      texts.push_back(s.text);
    }
  if (names.size() > kMostSentences)
    texts = {fmt::format("these poses tell too little of {}", fmt::join(names, ", "))};
  std::vector<Problem> out;
  for (auto& text : texts)
    out.push_back({Severity::kWarning, "W-CHECK-SEPARATE", std::move(text), std::nullopt,
                   "plumb explain W-CHECK-SEPARATE"});
  return out;
}

std::optional<Problem> nothing_told(const Cell& cell, const IdentifiabilityReport& report) {
  const auto& estimates = report.calibration.estimates;
  const bool any =
      std::any_of(estimates.begin(), estimates.end(), [](const auto& e) { return e.of_robot; });
  if (any || cell.effects.empty() || !is_geometry(cell.effects.front().name)) return std::nullopt;
  return Problem{
      Severity::kWarning, "W-CHECK-NOTHING",
      "these poses tell no number of the arm: where the tracker's frame and the reflector are "
      "explains all that they show",
      std::nullopt,
      cell.joints() == 1
          ? "a single joint shows no more through one point; the points fit the nominal arm"
          : "if the arm's own numbers are wanted, move all joints: plumb plan --n 30"};
}

std::optional<Problem> few_poses(const Cell& cell, const Measurements& measured,
                                 const IdentifiabilityReport& report) {
  const int axes = static_cast<int>(coordinates_of_each(cell, measured));
  const std::set<int> groups(measured.replicate_group.begin(), measured.replicate_group.end());
  const int coordinates = axes * static_cast<int>(groups.size());
  int needed = report.rank_anywhere;
  for (const auto& p : report.calibration.parameters) needed += p.of_effect() ? 1 : 0;
  needed = not_known_before(cell, needed);
  if (coordinates > check::kCoordinatesEach * needed) return std::nullopt;
  const bool too_few = coordinates <= needed;
  return Problem{
      too_few ? Severity::kError : Severity::kWarning, too_few ? "E-CHECK-FEW" : "W-CHECK-FEW",
      fmt::format("{} {} coordinates for {} numbers of arm, frame and target{}",
                  counted_words(static_cast<long long>(groups.size()), "pose gives", "poses give"),
                  coordinates, needed, needed > report.rank_anywhere ? " and effects" : ""),
      std::nullopt,
      fmt::format(
          "measure at least {} poses all over the joint limits",
          std::max(check::kAdvisedPoses, check::kAdvisedTimes * needed / std::max(1, axes)))};
}

std::optional<Problem> few_left_to_fit(const Cell& cell, const Measurements& measured,
                                       const IdentifiabilityReport& report) {
  const Split split = split_poses(measured, cell.measurement.held_out, cell.measurement.seed);
  const std::size_t readings = fewest_fitted(split);
  const std::size_t coordinates = coordinates_of_each(cell, measured) * readings;
  const auto numbers = static_cast<std::size_t>(not_known_before(cell, report.rank));
  if (coordinates > numbers) return std::nullopt;
  return Problem{
      Severity::kError, "E-CHECK-FEW",
      fmt::format("{} too few to hold some of them out: {} left to fit and give {} "
                  "coordinates for {} numbers of arm, frame and target",
                  counted_words(measured.size(), "reading is", "readings are"),
                  counted_words(static_cast<long long>(readings), "of them is", "of them are"),
                  coordinates, numbers),
      std::nullopt, "measure at least 30 poses all over the joint limits"};
}

}  // namespace plumb::offline

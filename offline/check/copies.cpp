// SPDX-License-Identifier: Apache-2.0
#include "check/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "check/constants.hpp"
#include "check/equal_repeats.hpp"
#include "check/row_lines.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

/// A row and an earlier one with exactly the same point, preferably one with the same joint
/// positions.
struct EqualPoint {
  int row = 0;
  int original = 0;
};

std::vector<EqualPoint> equal_points(const Measurements& m) {
  const auto point = [&](int i) { return std::array{m.p_M(i, 0), m.p_M(i, 1), m.p_M(i, 2)}; };
  std::vector<int> rows(static_cast<std::size_t>(m.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return point(a) < point(b); });
  std::vector<EqualPoint> out;
  auto first = rows.begin();
  for (auto at = rows.begin(); at != rows.end(); ++at) {
    if (point(*at) != point(*first)) first = at;
    if (at == first) continue;
    const auto end = first + std::min(at - first, check::kMostCompared);
    const auto same = std::find_if(first, end, [&](int k) { return m.q.row(k) == m.q.row(*at); });
    out.push_back({*at, same == end ? *first : *same});
  }
  return out;
}

bool is_repeat(const Measurements& m, const EqualPoint& equal) {
  return m.replicate_group[static_cast<std::size_t>(equal.row)] ==
         m.replicate_group[static_cast<std::size_t>(equal.original)];
}

bool same_joints(const Measurements& m, const EqualPoint& equal) {
  return m.q.row(equal.row) == m.q.row(equal.original);
}

/// Points that are copies of others, or may be.
struct Copies {
  std::vector<EqualPoint> points;
  double by_rounding = 0.0;  // expected number of them that are true repeats
  bool perhaps = false;      // the noise is unknown: copies or true repeats
};

/// Equal points at different poses are copies. Equal points at one pose are copies if there are
/// more of them than rounding explains: then all, or only those with equal joint positions too.
Copies copies_of(const Measurements& m, const EqualRepeats& chance) {
  Copies out;
  std::vector<EqualPoint> repeats, rows;
  for (const EqualPoint& equal : equal_points(m)) {
    (is_repeat(m, equal) ? repeats : out.points).push_back(equal);
    if (is_repeat(m, equal) && same_joints(m, equal)) rows.push_back(equal);
  }
  const auto too_many = [](const std::vector<EqualPoint>& some, double expected) {
    return static_cast<double>(some.size()) > most_by_chance(expected);
  };
  std::vector<EqualPoint> also;
  if (chance.assumed && chance.points >= check::kWorthSaying && out.points.empty()) {
    also = repeats;
    out.perhaps = true;
  } else if (too_many(repeats, chance.points)) {
    also = repeats;
    out.by_rounding = chance.points;
  } else if (too_many(rows, chance.rows)) {
    also = rows;
    out.by_rounding = chance.rows;
  }
  out.points.insert(out.points.end(), also.begin(), also.end());
  std::sort(out.points.begin(), out.points.end(),
            [](const EqualPoint& a, const EqualPoint& b) { return a.row < b.row; });
  return out;
}

/// The error for files whose poses are all the same. It says whether the arm moved while the joint
/// columns stayed constant.
Problem equal_poses(const MeasurementFiles& measured) {
  const double spread =
      (measured.p_M.colwise().maxCoeff() - measured.p_M.colwise().minCoeff()).norm();
  const bool arm_moved = spread > check::kOnePlace_m;
  return {Severity::kError, "E-CHECK-EQUAL",
          arm_moved ? fmt::format(
                          "every row has the same joint positions, but the points are up to {:.3g} "
                          "mm apart: these are not the joint positions of these points",
                          spread * 1e3)
                    : "every row has the same joint positions",
          cell_of_row(measured, 0, "q1", arm_moved ? "the same in every row" : "the only pose"),
          arm_moved ? "export the joint positions again, each row at its own pose"
                    : "measure at least 30 poses all over the joint limits"};
}

std::string why_perhaps(const Copies& copies, double step_m) {
  if (copies.perhaps)
    return fmt::format(
        "; the points are rounded to {:g} mm, so these may be copies or true repeats",
        step_m * 1e3);
  if (copies.by_rounding >= check::kWorthSaying)
    return fmt::format("; rounding alone would make about {:.0f} equal", copies.by_rounding);
  return "";
}

}  // namespace

std::vector<Problem> copy_findings(const MeasurementFiles& measured, const NoiseFloor& floor) {
  if (!measured.placement.empty()) return {};  // every touch of a point reads the same
  const EqualRepeats chance = equal_by_rounding(measured, floor);
  const Copies copies = copies_of(measured, chance);
  if (copies.points.empty()) return {};
  std::vector<int> rows;
  for (const EqualPoint& equal : copies.points) rows.push_back(equal.row);
  const EqualPoint& first = copies.points.front();
  return {
      {Severity::kWarning, "W-CHECK-COPY",
       fmt::format("{} of {} {} another one to the last digit, {}{}{}", rows.size(),
                   counted_words(measured.size(), "reading", "readings"),
                   rows.size() == 1 ? "repeats" : "repeat", listed_lines(measured, rows),
                   same_joints(measured, first) ? "" : ", at other joint positions",
                   why_perhaps(copies, chance.step_m)),
       cell_of_row(measured, first.row, measured.has_axis[0] ? "x" : "y",
                   measured.tables.empty()
                       ? ""
                       : fmt::format("as in line {}", line_of_row(measured, first.original))),
       copies.perhaps
           ? "export the points again with all their digits, and delete those that are still equal"
           : "delete the copies: a true repeat has its own reading, and copies hide the noise"}};
}

std::vector<Problem> equal_pose_findings(const MeasurementFiles& measured) {
  if (measured.size() < 2) return {};
  for (int i = 1; i < measured.size(); ++i)
    if (measured.q.row(i) != measured.q.row(0)) return {};
  return {equal_poses(measured)};
}

}  // namespace plumb::offline

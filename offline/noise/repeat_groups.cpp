// SPDX-License-Identifier: Apache-2.0
#include "noise/repeat_groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "noise/constants.hpp"

namespace plumb::offline {
namespace {

enum class Side { kAsMoved, kAsStated };

bool both_unknown(double a, double b) { return std::isnan(a) && std::isnan(b); }

bool within(const RowsN& values, int a, int b, double tolerance) {
  if (values.rows() == 0) return true;
  for (Eigen::Index k = 0; k < values.cols(); ++k)
    if (!(std::abs(values(a, k) - values(b, k)) <= tolerance) &&
        !both_unknown(values(a, k), values(b, k)))
      return false;
  return true;
}

int sign_of(double move) { return move > kStillShare ? 1 : move < -kStillShare ? -1 : 0; }

bool same_side(const RowsN& moves, int a, int b) {
  if (moves.rows() == 0) return true;
  for (Eigen::Index k = 0; k < moves.cols(); ++k)
    if (sign_of(moves(a, k)) != sign_of(moves(b, k))) return false;
  return true;
}

bool alike(const ContextRows& c, Side side, int a, int b) {
  return within(c.payload, a, b, kSameLoad) && within(c.wrench, a, b, kSameForce) &&
         within(c.temperature, a, b, kSameTemperature_K) && same_side(c.direction, a, b) &&
         (side == Side::kAsStated || same_side(c.step, a, b));
}

struct Groups {
  std::vector<int> of_row;
  int count = 0;
};

Groups groups_by(const Measurements& measured, Side side) {
  std::map<int, std::vector<int>> firsts;  // for each pose, the first row of each of its groups
  Groups out;
  for (int i = 0; i < measured.size(); ++i) {
    auto& known = firsts[measured.replicate_group[static_cast<std::size_t>(i)]];
    // The latest group is tried first, because successive rows mostly share their context.
    const auto mine = std::find_if(known.rbegin(), known.rend(), [&](int first) {
      return alike(measured.context, side, first, i);
    });
    const bool is_new = mine == known.rend();
    out.of_row.push_back(is_new ? out.count++ : out.of_row[static_cast<std::size_t>(*mine)]);
    if (is_new) known.push_back(i);
  }
  return out;
}

}  // namespace

std::vector<int> repeat_groups(const Measurements& measured) {
  Groups moved = groups_by(measured, Side::kAsMoved);
  if (measured.size() - moved.count >= kEnoughRepeats) return std::move(moved.of_row);
  return groups_by(measured, Side::kAsStated).of_row;
}

}  // namespace plumb::offline

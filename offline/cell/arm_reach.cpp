// SPDX-License-Identifier: Apache-2.0
#include "cell/arm_reach.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

/// Largest joint position [rad] or [m] and coordinate [m]: 1,600 turns or ten kilometres.
constexpr double kFarthest = 1e4;

void check(const Table& table, const Column* column, const char* whose, ProblemList& problems) {
  for (int row = 0; column != nullptr && row < table.rows() && !problems.full(); ++row) {
    const double value = column->values[row];
    if (std::abs(value) <= kFarthest) continue;
    const bool turns = column->quantity == Quantity::kAngle;
    problems.error("E-CSV-FAR",
                   fmt::format("column '{}': {:.3g} {} is nothing {} can have", column->header,
                               turns ? value / (2.0 * M_PI) : value, turns ? "turns" : "m", whose),
                   place_in_row(table, row, *column, fmt::format("read in '{}'", column->unit)),
                   "correct the unit in the column's name, or the number, or delete the row");
  }
}

}  // namespace

void check_reach(const Table& table, const ArmColumns& columns, ProblemList& problems) {
  for (const Column* q : columns.q) check(table, q, "a joint", problems);
  for (const Column* p : columns.p) check(table, p, "a measured point", problems);
  for (const Column* n : columns.nominal) check(table, n, "a point of an arm", problems);
}

}  // namespace plumb::offline

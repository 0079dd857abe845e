// SPDX-License-Identifier: Apache-2.0
#include "check/error_cause.hpp"

#include <utility>

#include "check/contradiction.hpp"
#include "check/moved_part.hpp"
#include "check/row_faults.hpp"
#include "check/row_pattern.hpp"
#include "noise/main_jump.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

std::vector<int> not_outliers(const std::vector<int>& rows, const LargeErrors& errors) {
  return errors.fit != nullptr ? without_outliers(rows, errors.fit->outliers) : rows;
}

}  // namespace

ErrorCause error_cause(const Cell& cell, const MeasurementFiles& measured,
                       const std::vector<int>& rows, const LargeErrors& errors) {
  if (!errors.otherwise_meant)
    if (auto found = row_fault_findings(cell, measured, rows, errors.placed); !found.empty())
      return {.words = "some rows were written otherwise than the rest, see W-CHECK-ROWS",
              .findings = std::move(found),
              .explains_outliers = true,
              .moved = ""};
  if (errors.scale)
    return {.words = "one common factor on all points would, see W-CHECK-SCALE",
            .findings = {errors.scale->finding},
            .moved = ""};
  if (!errors.otherwise_meant && !errors.setups_moved)
    if (auto found = moved_part(cell, measured,
                                not_outliers(thinned(measured, rows, kRowsSearchedForJump), errors),
                                errors.placed))
      return {.words = found->words + ", see W-CHECK-MOVED",
              .findings = {std::move(found->finding)},
              .moved = found->words};
  if (errors.fit != nullptr)
    if (auto pattern = pattern_findings(measured, rows, errors.placed); !pattern.empty())
      return {.words = "", .findings = std::move(pattern), .moved = ""};
  if (auto found = contradiction(cell, measured, not_outliers(rows, errors), errors.placed))
    return {.words = "a part of the readings contradicts the rest, see W-CHECK-CONTRADICT",
            .findings = {std::move(*found)},
            .explains_outliers = true,
            .moved = ""};
  return {};
}

}  // namespace plumb::offline

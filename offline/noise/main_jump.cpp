// SPDX-License-Identifier: Apache-2.0
#include "noise/main_jump.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"

namespace plumb::offline {
namespace {

constexpr double kMostOfTheError = 0.3;  // least share of the squared error of a cause
/// Largest share of a real jump. It is 1 or less where a part moves the points alike in the poses
/// before and behind the jump; those of real series differ.
constexpr double kAllOfTheError = 2.0;
constexpr double kClear_ln_p = -6.9;  // by chance once in a thousand
constexpr double kOnePayload_kg = 1e-6;
constexpr int kRowsOfOnePayload = 4;
constexpr int kRowsAround = 2;  // a small jump may be found a row or two too early or too late

/// Whether one payload hangs on the arm up to this row and another one behind it.
bool payload_changes_behind(const Measurements& m, int row) {
  const auto differ = [&](int a, int b) {
    return std::abs(m.context.payload(a, 0) - m.context.payload(b, 0)) > kOnePayload_kg;
  };
  if (row + 1 < kRowsOfOnePayload || row + kRowsOfOnePayload >= m.size()) return false;
  if (!differ(row, row + 1)) return false;
  for (int k = 1; k < kRowsOfOnePayload; ++k)
    if (differ(row - k, row) || differ(row + 1, row + 1 + k)) return false;
  return true;
}

/// Whether a change of payload explains the jump: the arm or the floor then yields, which looks
/// like a moved joint zero or base. A jump of the tool is always taken for a moved reflector or
/// tool.
bool may_be_payload(const Measurements& m, const StepFound& step) {
  if (step.source == MotionSource::kTool || m.context.payload.rows() == 0) return false;
  for (int row = step.earliest - kRowsAround; row <= step.latest + kRowsAround; ++row)
    if (payload_changes_behind(m, row)) return true;
  return false;
}

}  // namespace

double share_of_error(const StepFound& step, double rms_m, double rows) {
  const double before = static_cast<double>(step.before + 1) / rows;
  return rms_m > 0.0 ? step.size_m * step.size_m * before * (1.0 - before) / (rms_m * rms_m) : 1.0;
}

bool is_clear(const StepFound& step) { return step.ln_p <= kClear_ln_p; }

bool is_possible(double share) { return share <= kAllOfTheError; }

bool is_cause(double share) { return share >= kMostOfTheError && is_possible(share); }

std::optional<StepFound> main_jump(const ArmState& fitted, const Measurements& measured,
                                   const std::vector<int>& rows) {
  if (rows.empty()) return std::nullopt;
  const Measurements some = pick(measured, rows);
  std::vector<int> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  const Rows3 error_M = residuals(some, predict_points(fitted, some));
  const double count = static_cast<double>(rows.size());
  const double rms = std::sqrt(error_M.squaredNorm() / count);
  const Changes found = change_points(StepMotions(fitted, some, series(some, error_M, all)));
  std::optional<StepFound> out;
  double most = 0.0;
  for (const StepFound& step : found.steps) {
    const double share = share_of_error(step, rms, count);
    if (!is_clear(step) || !is_cause(share) || share <= most || may_be_payload(some, step))
      continue;
    most = share;
    out = step;
  }
  if (out)
    for (int* row : {&out->before, &out->after, &out->earliest, &out->latest})
      *row = rows[static_cast<std::size_t>(*row)];
  return out;
}

std::string size_in_mm(const StepFound& step) {
  const double mm = step.size_m * 1e3;
  return mm < 10.0 ? fmt::format("{:.2g}", mm) : fmt::format("{:.0f}", mm);
}

}  // namespace plumb::offline

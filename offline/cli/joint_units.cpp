// SPDX-License-Identifier: Apache-2.0
#include "cli/joint_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kLargestRadians_deg = 2.0 * std::numbers::pi;  // as read, if it is in radians
constexpr double kOffZero_deg = 0.05;    // below: a joint at zero in any unit
constexpr double kWideRange_deg = 20.0;  // range of a joint in the fit
constexpr double kBesideRange = 0.1;     // margin on either side, share of that range
constexpr double kNearlyAllRows = 0.8;   // share of the rows

}  // namespace

JointUnits::JointUnits(const format::Model& model) {
  const format::Domain& domain = model.domain;
  const auto& joints = model.calibrated.joints;
  std::size_t wide = 0, turning = 0;
  for (std::size_t j = 0; j < std::min(joints.size(), domain.q_min.size()); ++j) {
    const double width = domain.q_max[j] - domain.q_min[j];
    Range range{.turns = !show::slides(joints[j]),
                .low = domain.q_min[j] - kBesideRange * width,
                .high = domain.q_max[j] + kBesideRange * width};
    turning += range.turns ? 1 : 0;
    wide += range.turns && show::to_deg(width) > kWideRange_deg ? 1 : 0;
    ranges_.push_back(range);
  }
  wide_ = turning > 0 && 2 * wide >= turning;
}

void JointUnits::name_column(const Table& rows) {
  if (const Column* q = rows.find("q1"); q != nullptr) column_ = q->header;
}

void JointUnits::add(std::span<const double> q) {
  ++rows_;
  std::size_t turning = 0, moved = 0;
  bool inside = true, large = false;
  for (std::size_t j = 0; j < std::min(q.size(), ranges_.size()); ++j) {
    if (!ranges_[j].turns) continue;
    const double read_deg = show::to_deg(q[j]);
    ++turning;
    moved += std::abs(read_deg) > kOffZero_deg ? 1 : 0;
    large = large || !(std::abs(read_deg) <= kLargestRadians_deg);
    inside = inside && read_deg >= ranges_[j].low && read_deg <= ranges_[j].high;
  }
  large_ += large ? 1 : 0;
  inside_ += inside && 2 * moved >= turning ? 1 : 0;
}

void JointUnits::add(const JointUnits& more) {
  column_ = more.column_;
  rows_ += more.rows_;
  large_ += more.large_;
  inside_ += more.inside_;
}

std::optional<Problem> JointUnits::remark() const {
  const bool nearly_all =
      static_cast<double>(inside_) >= kNearlyAllRows * static_cast<double>(rows_);
  if (!wide_ || rows_ == 0 || large_ > 0 || !nearly_all || !column_.ends_with("_deg"))
    return std::nullopt;
  return Problem{
      .severity = Severity::kWarning,
      .code = "W-PREDICT-RADIANS",
      .message = fmt::format(
          "no joint is beyond 6.3 deg in {} row{}, and as radians they lie within what the model "
          "was fitted with: radians in {} ...?",
          rows_, rows_ == 1 ? "" : "s", column_),
      .help = "if they are radians, name the columns q1_rad ..."};
}

}  // namespace plumb::offline::cli
